// The leaves of a tree that each search finds near its leaf: how many, or with LIST which. An invocation a search.
// CPU twin: gelatin::cpu::FindPairs::walk. Parity: tests/gpu/implicit/find_pairs_test.cpp.
#include "include/global_index.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/implicit/list_starts.glsl"
#include "sim/implicit/own_pairs.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer pair_slots;  // PairSlot
uniform usamplerBuffer searches;    // leaf, slot
#ifdef LIST
uniform usamplerBuffer walk_starts;  // by search
uniform usamplerBuffer walk_sums;
uniform uint leaf_pair_capacity;
layout(std430) writeonly buffer LeafPairs { uvec2 leaf_pairs[]; };  // search, leaf
#else
layout(std430) writeonly buffer Starts { uint starts[]; };  // counts
#endif

void main() {
    uint k = global_index();
    if (k >= dispatches[2u * kOfSearches].count) return;
    uvec2 search = texelFetch(searches, int(k)).xy;
    uvec2 slot = texelFetch(pair_slots, int(search.y)).xy;
    Bounds box = swept(tree_bounds(search.x), motion_of(slot.x) - motion_of(slot.y));
    bool is_limited = slot.x == slot.y && is_convex(slot.x);  // to lines that meet what was lost
    Bounds lost = box, own = box;
    if (is_limited) {
        lost = lost_bounds(slot.x);
        own = rest_bounds(search.x);
    }
    uint node = root_of(slot.y), end = texelFetch(tree_nodes, int(node)).x, count = 0u;
#ifdef LIST
    uint first = list_start(walk_starts, walk_sums, k);
#endif
    while (node < end) {
        uvec4 at = texelFetch(tree_nodes, int(node));
        bool is_near = meet(box, tree_bounds(node)) && (!is_limited || meet(lost, joined(own, rest_bounds(node))));
        if (is_near && at.z > 0u) {
#ifdef LIST
            if (first + count < leaf_pair_capacity) leaf_pairs[first + count] = uvec2(k, node);
#endif
            ++count;
        }
        node = is_near ? node + 1u : at.x;
    }
#ifndef LIST
    starts[k] = count;
#endif
}
