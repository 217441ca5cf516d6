// Which leaves of the first object's tree search the other one's, of each slot: how many, or with LIST which, in ascending order: those
// that may come near its box and have nodes or edges. A work group a slot.
// CPU twin: gelatin::cpu::FindPairs. Parity: tests/gpu/implicit/find_pairs_test.cpp.
const uint kLanes = 256u;
#include "include/global_index.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/list_starts.glsl"
#include "sim/implicit/path_trees.glsl"
layout(local_size_x = 256) in;

uniform usamplerBuffer pair_slots;      // PairSlot
uniform usamplerBuffer leaf_starts;     // by object, and the end, in level_nodes
uniform usamplerBuffer face_starts;     // of each face in surface_nodes and face_edges
layout(std430) readonly buffer LevelNodes { uint level_nodes[]; };  // leaves first
#ifdef LIST
uniform usamplerBuffer search_starts;   // by slot
uniform usamplerBuffer search_sums;
uniform uint search_capacity;
layout(std430) writeonly buffer Searches { uvec2 searches[]; };  // leaf, slot
#else
layout(std430) writeonly buffer Starts { uint starts[]; };  // counts
#endif

bool is_near(uint leaf, Bounds bounds, vec3 motion, Bounds other, vec3 beside) {
    uvec4 faces = texelFetch(tree_nodes, int(leaf));
    if (texelFetch(face_starts, int(faces.y)).xy == texelFetch(face_starts, int(faces.y + faces.z)).xy) return false;
    Bounds box = tree_bounds(leaf);
    return meet(swept(box, motion), bounds) && meet(swept(box, beside), other);
}

void main() {
    uint s = group_index(), lane = gl_LocalInvocationID.x;
    if (s >= dispatches[2u * kOfSlots].count) return;
    uvec2 slot = texelFetch(pair_slots, int(s)).xy;
    uint first = texelFetch(leaf_starts, int(slot.x)).x, end = texelFetch(leaf_starts, int(slot.x) + 1).x, count = 0u;
    Bounds bounds = bounds_of(slot.y), other = tree_bounds(root_of(slot.y));
    vec3 motion = motion_of(slot.x), beside = motion - motion_of(slot.y);
    for (uint base = first; base < end; base += kLanes) {
        uint k = base + lane, all, leaf = level_nodes[min(k, end - 1u)];
        bool searches_it = k < end && is_near(leaf, bounds, motion, other, beside);
        uint before = count_before(searches_it ? 1u : 0u, all);
#ifdef LIST
        uint place = list_start(search_starts, search_sums, s) + count + before;
        if (searches_it && place < search_capacity) searches[place] = uvec2(leaf, s);
#endif
        count += all;
    }
#ifndef LIST
    if (lane == 0u) starts[s] = count;
#endif
}
