// Where groups of elements begin in the next list, how many that has, and what is done next; nothing where there is no place for them.
// One work group.
// CPU twin: gelatin::cpu::FindPairs. Parity: tests/gpu/implicit/find_pairs_test.cpp.
const uint kLanes = 256u;
#define WRITES_DISPATCHES
#include "layouts/near_pair.glsl"
#include "layouts/pair_stages.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/group_counts.glsl"
layout(local_size_x = 256) in;

uniform uint stage;
uniform uint search_capacity;
uniform uint leaf_pair_capacity;
uniform uint pair_capacity;
layout(std430) buffer GroupSums { uint group_sums[]; };
layout(std430) buffer Counts { PairCounts counts[]; };

// Of stages after this one. @return whether there is a place for what was found
bool begin_next(uint count) {
    uint capacity = stage == kOfSlots ? search_capacity : stage == kOfSearches ? leaf_pair_capacity : pair_capacity;
    bool is_full = count > capacity;
    if (is_full) counts[0].is_full = 1u;
    if (stage == kOfSlots) {
        counts[0].searches = count;
    } else if (stage == kOfSearches) {
        counts[0].leaf_pairs = count;
    } else {
        counts[0].pairs = count;
    }
    return !is_full;
}

void main() {
    Dispatch sums = dispatches[2u * stage + 1u];
    if (sums.groups_x == 0u) return;
    uint groups = sums.count / kCountsAGroup + 1u, share = (groups + kLanes - 1u) / kLanes;
    uint first = share * gl_LocalInvocationID.x, end = min(first + share, groups), own = 0u, all;
    for (uint g = first; g < end; ++g) own += group_sums[g];
    uint at = count_before(own, all);
    for (uint g = first; g < end; ++g) {
        uint next = at + group_sums[g];
        group_sums[g] = at;
        at = next;
    }
    if (gl_LocalInvocationID.x != 0u || !begin_next(all)) return;
    if (stage == kOfLeafPairs) {
        dispatches[kWrites] = dispatches[2u * kOfLeafPairs];
        dispatches[kSlotEnds] = dispatch_invocations(counts[0].slots);
        if (clock[0].guards != 0u) return;
        dispatches[kNearPairs] = dispatch_invocations(all);
        dispatches[kSlotGroups] = make_dispatch(counts[0].slots, counts[0].slots);
        return;
    }
    uint lanes = stage == kOfSlots ? 1u : kLanesALeafPair;
    Dispatch next = dispatch_invocations(all * lanes);
    next.count = all;
    dispatches[2u * stage + 2u] = next;
    dispatches[2u * stage + 3u] = make_dispatch(all, all / kCountsAGroup + 1u);
}
