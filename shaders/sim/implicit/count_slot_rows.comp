// The rows of each slot: their places in the order of its pairs, how many there are, and what they have in common; and the slot of
// the same objects the other way round. A work group a slot.
// CPU twin: gelatin::cpu::ContactRows::make. Parity: tests/gpu/implicit/pair_rows_test.cpp.
const uint kLanes = 64u;
#include "include/global_index.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/near_pairs.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer slot_starts;  // of each object, and the end
layout(std430) buffer PairWeights { PairWeight pair_weights[]; };
layout(std430) writeonly buffer RowsOfSlots { SlotRows slot_rows[]; };

// In an object's list, which ascends; kNone: it is not there.
uint find_slot(uint object, uint other) {
    uint first = texelFetch(slot_starts, int(object)).x, end = texelFetch(slot_starts, int(object) + 1).x, last = end;
    while (first < end) {
        uint middle = (first + end) / 2u;
        if (texelFetch(pair_slots, int(middle)).y < other) first = middle + 1u;
        else end = middle;
    }
    return first < last && texelFetch(pair_slots, int(first)).y == other ? first : kNone;
}

void main() {
    uint s = group_index();
    if (s >= counts[0].slots) return;
    uvec4 slot = texelFetch(pair_slots, int(s));
    uint count = 0u, all;
    float nearest = 1.0, deepest = 0.0;
    for (uint base = slot.z; base < slot.w; base += kLanes) {
        uint p = base + gl_LocalInvocationID.x;
        bool has_row = p < slot.w && pair_weights[p].stiffness > 0.0;
        uint before = count_before(has_row ? 1u : 0u, all);
        if (has_row) {
            vec4 normal = uintBitsToFloat(texelFetch(near_pairs, 5 * int(p) + 2));
            float reach = uintBitsToFloat(texelFetch(near_pairs, 5 * int(p) + 4).z), known = pair_weights[p].known_reach;
            pair_weights[p].place = count + before;
            if (known > 0.0) nearest = min(nearest, normal.w / known);
            deepest = max(deepest, -pair_weights[p].there / reach);
        }
        count += all;
    }
    nearest = -max_over_group(-nearest);
    deepest = max_over_group(deepest);
    if (gl_LocalInvocationID.x == 0u) slot_rows[s] = SlotRows(count, find_slot(slot.y, slot.x), nearest, deepest);
}
