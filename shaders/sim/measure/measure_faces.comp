// Volume under the faces of a chunk, about a node of the object (divergence theorem), one work group a chunk; the host
// adds the chunks up in double precision. CPU twin: gelatin::cpu::measure. Parity: tests/gpu/measure/measure_test.cpp.
#include "include/global_index.glsl"
#include "layouts/chunk.glsl"
#include "layouts/face.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;  // xyz [m]
layout(std430) readonly buffer Chunks { Chunk chunks[]; };
layout(std430) writeonly buffer Volumes { float volumes[]; };  // [m^3]
layout(std430) readonly buffer Faces { Face faces[]; };
uniform uint chunk_count;

shared float parts[64];

void main() {
    uint group = group_index();
    if (group >= chunk_count) return;  // the whole group leaves, so no one waits at the barrier
    Chunk chunk = chunks[group];
    vec3 origin = texelFetch(positions, int(chunk.origin)).xyz;
    uint lane = gl_LocalInvocationID.x;
    float volume = 0.0;
    for (uint k = lane; k < chunk.count; k += 64u) {
        Face face = faces[chunk.first + k];
        vec3 a = texelFetch(positions, int(face.a)).xyz - origin;
        vec3 b = texelFetch(positions, int(face.b)).xyz - origin;
        vec3 c = texelFetch(positions, int(face.c)).xyz - origin;
        volume += dot(a, cross(b, c)) / 6.0;
    }
    parts[lane] = volume;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) volume += parts[l];
    volumes[group] = volume;
}
