// What bodies have in common where a part begins, from sums over their chunks: momenta, contacts, how they move on, and whether
// nodes were let go or taken hold of. A work group a body.
// CPU twin: gelatin::cpu::Islands::find. Parity: tests/gpu/implicit/part_start_test.cpp.
const uint kLanes = 64u;
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/node_chunks.glsl"
layout(local_size_x = 64) in;

uniform uint body_count;
uniform uint has_forces;  // 1: loads or hands act
layout(std430) readonly buffer PartSums { StartSums part_sums[]; };
layout(std430) buffer RowsOfChunks { ChunkRows chunk_rows[]; };
layout(std430) writeonly buffer RowsOfBodies { BodyRows body_rows[]; };
layout(std430) buffer Paces { BodyPace paces[]; };

StartSums sum_chunks(uint first, uint end) {
    StartSums own = StartSums(vec4(0.0), vec4(0.0), 0.0, 0.0, 0.0, 0.0);
    for (uint c = first + gl_LocalInvocationID.x; c < end; c += kLanes) {
        own.momentum += part_sums[c].momentum;
        own.carried += part_sums[c].carried;
        own.held_count += part_sums[c].held_count;
    }
    return StartSums(sum_over_group(own.momentum), sum_over_group(own.carried), sum_over_group(own.held_count), 0.0, 0.0, 0.0);
}

// And numbers the rows of chunks.
BodyRows sum_rows(uint first, uint end) {
    float nearest = 1.0, deepest = 0.0;
    uint count = 0u;
    for (uint base = first; base < end; base += kLanes) {
        uint c = base + gl_LocalInvocationID.x, all, own = 0u;
        if (c < end) {
            own = chunk_rows[c].count;
            nearest = min(nearest, chunk_rows[c].nearest);
            deepest = max(deepest, chunk_rows[c].deepest);
        }
        uint before = count_before(own, all);
        if (c < end) chunk_rows[c].first = count + before;
        count += all;
    }
    nearest = -max_over_group(-nearest);
    return BodyRows(count, 0u, nearest, max_over_group(deepest));
}

void main() {
    uint o = group_index();
    if (o >= body_count || !goes_on()) return;
    uint first = texelFetch(chunk_starts, int(o)).x, end = texelFetch(chunk_starts, int(o) + 1).x;
    StartSums sums = sum_chunks(first, end);
    BodyRows rows = sum_rows(first, end);
    if (gl_LocalInvocationID.x != 0u) return;
    float mass = sums.momentum.w;
    uint held = uint(sums.held_count);
    bool is_driven = has_forces != 0u || rows.count > 0u;
    vec3 velocity = vec3(0.0);
    if (!is_driven && mass > 0.0) velocity = held > 0u ? sums.carried.xyz / sums.carried.w : sums.momentum.xyz / mass;
    if (paces[o].held_count != held) {
        paces[o].held_count = held;
        paces[o].is_struck = 1u;
    }
    body_rows[o] = rows;
    paces[o].is_held = is_driven || held > 0u ? 1u : 0u;
    paces[o].velocity = vec4(velocity, mass);
}
