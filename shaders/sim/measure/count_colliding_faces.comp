// Faces of each chunk that touch another object, or with SELF_COLLISION their own, one work group a chunk, and behind
// them the pairs that were lost.
// Parity: tests/gpu/collision/collision_test.cpp.
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_collisions.glsl"
#include "layouts/chunk.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer Chunks { Chunk chunks[]; };
layout(std430) writeonly buffer Colliding { uint colliding[]; };  // of each chunk, and the losses
uniform uint chunk_count;

shared uint count;

void main() {
    uint group = group_index();
    if (group >= chunk_count) return;  // the whole group leaves, so no one waits at the barrier
    if (gl_LocalInvocationID.x == 0u) count = 0u;
    barrier();
    Chunk chunk = chunks[group];
    PairRow row = pair_rows[chunk.object];
    for (uint k = gl_LocalInvocationID.x; k < chunk.count; k += 64u) {
        atomicAdd(count, uint(collides_with_any(row, chunk.first + k)));
    }
    barrier();
    if (gl_LocalInvocationID.x != 0u) return;
    colliding[group] = count;
    if (group == 0u) colliding[chunk_count] = dispatches[kLosses].count;
}
