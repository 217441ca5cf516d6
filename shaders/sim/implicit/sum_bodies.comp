// What bodies have in common where a part begins, from sums over their chunks: momenta, contacts, how they move on, and whether
// nodes were let go or taken hold of. With PAIRS bodies touch each other: how they move on their islands say (sum_islands.comp). A
// work group a body.
// CPU twin: gelatin::cpu::Islands::find. Parity: tests/gpu/implicit/part_start_test.cpp, pair_rows_test.cpp.
const uint kLanes = 64u;
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/node_chunks.glsl"
#ifdef PAIRS
#include "layouts/contact_tuning.glsl"
#include "sim/implicit/near_pairs.glsl"
#endif
#include "sim/implicit/common_motion.glsl"
layout(local_size_x = 64) in;

#ifndef PAIRS
uniform uint body_count;
#endif
uniform uint has_forces;  // 1: loads or hands act
layout(std430) readonly buffer PartSums { StartSums part_sums[]; };
layout(std430) buffer RowsOfChunks { ChunkRows chunk_rows[]; };
layout(std430) writeonly buffer RowsOfBodies { BodyRows body_rows[]; };
layout(std430) buffer Paces { BodyPace paces[]; };

#ifdef PAIRS
uniform usamplerBuffer slot_starts;  // of each object, and the end
uniform usamplerBuffer slot_rows;    // SlotRows, a texel each
layout(std430) writeonly buffer BodyTouches { BodyTouch body_touches[]; };
layout(std430) writeonly buffer StartsOfBodies { StartSums body_starts[]; };

// Of its own: rows, pairs, chunks of rows.
vec3 in_tables(uint count) { return vec3(count, count > 0u ? 1u : 0u, (count + kRowsOfChunk - 1u) / kRowsOfChunk); }

BodyTouch find_touch(uint o, BodyRows planes) {
    vec4 sums = vec4(0.0);  // w: couplings
    float deepest = 0.0, is_driven = 0.0;
    uint end = counts[0].is_full == 0u ? texelFetch(slot_starts, int(o) + 1).x : 0u;
    for (uint s = texelFetch(slot_starts, int(o)).x + gl_LocalInvocationID.x; s < end; s += kLanes) {
        uint other = texelFetch(pair_slots, int(s)).y;
        uvec4 slot = texelFetch(slot_rows, int(s)), twin = slot.y == kNone ? uvec4(0u) : texelFetch(slot_rows, int(slot.y));
        sums.xyz += in_tables(slot.x);
        deepest = max(deepest, uintBitsToFloat(slot.w));
        if (other == o) continue;
        sums.w += (slot.x > 0u ? 1.0 : 0.0) + (twin.x > 0u ? 1.0 : 0.0);
        if (is_body(other)) continue;
        sums.xyz += in_tables(twin.x);
        deepest = max(deepest, uintBitsToFloat(twin.w));
        if (slot.x + twin.x > 0u) is_driven = 1.0;
    }
    sums = sum_over_group(sums) + vec4(in_tables(planes.count), planes.count > 0u ? 1.0 : 0.0);
    deepest = max(max_over_group(deepest), planes.deepest);
    is_driven = max(max_over_group(is_driven), planes.count > 0u ? 1.0 : 0.0);
    return BodyTouch(uint(sums.x), uint(sums.y), uint(sums.z), uint(sums.w), planes.count, uint(is_driven), deepest, 0u);
}
#endif

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
    if (o >= body_count) return;
    uint first = texelFetch(chunk_starts, int(o)).x, end = texelFetch(chunk_starts, int(o) + 1).x;
    StartSums sums = sum_chunks(first, end);
    BodyRows rows = sum_rows(first, end);
#ifdef PAIRS
    BodyTouch touch = find_touch(o, rows);
#endif
    if (gl_LocalInvocationID.x != 0u) return;
    uint held = uint(sums.held_count);
    if (paces[o].held_count != held) {
        paces[o].held_count = held;
        paces[o].is_struck = 1u;
    }
    body_rows[o] = rows;
#ifdef PAIRS
    body_touches[o] = touch;
    body_starts[o] = sums;
#else
    bool is_driven = has_forces != 0u || rows.count > 0u;
    paces[o].is_held = is_driven || held > 0u ? 1u : 0u;
    paces[o].velocity = common_motion(sums, is_driven);
#endif
}
