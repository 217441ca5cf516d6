// The box of each face, and of each chunk of faces: one work group a chunk. CPU twin: gelatin::cpu::Collision.
// Parity: tests/gpu/collision_test.cpp.
#include "include/box_reduction.glsl"
#include "include/global_index.glsl"
#include "layouts/chunk.glsl"
#include "layouts/face.glsl"

layout(binding = 0) uniform samplerBuffer positions;  // xyz [m]
layout(std430, binding = 0) readonly buffer Chunks { Chunk chunks[]; };
layout(std430, binding = 1) readonly buffer Faces { Face faces[]; };
layout(std430, binding = 2) writeonly buffer FaceBoxes { Box face_boxes[]; };
layout(std430, binding = 3) writeonly buffer ChunkBoxes { Box chunk_boxes[]; };
uniform uint chunk_count;

void main() {
    uint group = group_index();
    if (group >= chunk_count) return;  // the whole group leaves, so no one waits at the barrier
    Chunk chunk = chunks[group];
    Box box = empty_box();
    for (uint k = gl_LocalInvocationID.x; k < chunk.count; k += 64u) {
        Face face = faces[chunk.first + k];
        vec3 a = texelFetch(positions, int(face.a)).xyz;
        vec3 b = texelFetch(positions, int(face.b)).xyz;
        vec3 c = texelFetch(positions, int(face.c)).xyz;
        Box face_box = Box(vec4(min(a, min(b, c)), 0.0), vec4(max(a, max(b, c)), 0.0));
        face_boxes[chunk.first + k] = face_box;
        box = join(box, face_box);
    }
    box = reduce_box(box);
    if (gl_LocalInvocationID.x == 0u) chunk_boxes[group] = box;
}
