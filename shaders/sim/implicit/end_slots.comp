// Which near pairs each slot has. An invocation a slot.
// CPU twin: gelatin::cpu::FindPairs. Parity: tests/gpu/implicit/find_pairs_test.cpp.
#include "include/global_index.glsl"
#include "layouts/near_pair.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/implicit/list_starts.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer search_starts;  // by slot
uniform usamplerBuffer search_sums;
uniform usamplerBuffer walk_starts;    // by search
uniform usamplerBuffer walk_sums;
uniform usamplerBuffer hit_starts;     // by leaf pair
uniform usamplerBuffer hit_sums;
layout(std430) buffer PairSlots { PairSlot slots[]; };

uint first_pair(uint slot) {
    uint walk = list_start(walk_starts, walk_sums, list_start(search_starts, search_sums, slot));
    return list_start(hit_starts, hit_sums, walk);
}

void main() {
    uint s = global_index();
    if (s >= dispatches[kSlotEnds].count) return;
    slots[s].first_pair = first_pair(s);
    slots[s].pair_end = first_pair(s + 1u);
}
