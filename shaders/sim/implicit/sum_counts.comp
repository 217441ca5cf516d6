// Prefix sums of what the elements of a list have of the next, within groups of elements; place_lists.comp adds up the groups'. The
// list has one more element, which has nothing: where all end.
// CPU twin: gelatin::cpu::FindPairs. Parity: tests/gpu/implicit/find_pairs_test.cpp.
const uint kLanes = 256u;
#include "include/global_index.glsl"
#include "layouts/pair_stages.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/implicit/group_counts.glsl"
layout(local_size_x = 256) in;

uniform uint stage;
layout(std430) buffer Starts { uint starts[]; };  // counts before
layout(std430) writeonly buffer GroupSums { uint group_sums[]; };

void main() {
    uint group = group_index(), count = dispatches[2u * stage].count;
    if (group * kCountsAGroup > count) return;
    const uint share = kCountsAGroup / kLanes;
    uint first = share * global_index(), end = min(first + share, count + 1u), own = 0u, all;
    for (uint k = first; k < min(end, count); ++k) own += starts[k];
    uint at = count_before(own, all);
    for (uint k = first; k < end; ++k) {
        uint next = at + (k < count ? starts[k] : 0u);
        starts[k] = at;
        at = next;
    }
    if (gl_LocalInvocationID.x == 0u) group_sums[group] = all;
}
