// The box of each object from those of its chunks: one work group an object. CPU twin: gelatin::cpu::Collision.
// Parity: tests/gpu/collision_test.cpp.
#include "include/box_reduction.glsl"
#include "include/global_index.glsl"

layout(std430, binding = 0) buffer BoundingBoxes { BoundingBox bounding_boxes[]; };
layout(std430, binding = 1) readonly buffer ChunkBoxes { Box chunk_boxes[]; };
layout(std430, binding = 2) readonly buffer ChunkStarts { uint chunk_starts[]; };  // of each object, and the end
uniform uint object_count;

void main() {
    uint object = group_index();
    if (object >= object_count) return;  // the whole group leaves, so no one waits at the barrier
    Box box = empty_box();
    uint end = chunk_starts[object + 1u];
    for (uint c = chunk_starts[object] + gl_LocalInvocationID.x; c < end; c += 64u) box = join(box, chunk_boxes[c]);
    box = reduce_box(box);
    if (gl_LocalInvocationID.x != 0u) return;
    bounding_boxes[object].min = box.min;
    bounding_boxes[object].max = box.max;
}
