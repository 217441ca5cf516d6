// The objects that each leaf may be near, in ascending order, its own among them if OWN: their boxes meet the leaf's. CPU twin:
// gelatin::cpu::FindProximities. Parity: tests/gpu/proximity/find_proximities_test.cpp.
#define WRITES_DISPATCHES
#include "sim/collision/pairs.glsl"
#include "sim/proximity/proximities.glsl"
layout(local_size_x = 64) in;

layout(std430) buffer LeafSearches { LeafSearch searches[]; };
layout(std430) writeonly buffer NearObjects { NearObject near_objects[]; };
uniform uint search_count;
uniform uint near_object_capacity;

// The k-th object that the leaf's object may touch, in ascending order; with OWN it is among them.
uint nth_object(PairRow row, uint own, uint place_of_own, uint k) {
    if (k == place_of_own) return own;
    return object_pairs[row.first_pair + k - uint(k > place_of_own)].other;
}

void main() {
    uint leaf = global_index();
    if (leaf >= search_count) return;
    uint node = texelFetch(leaf_nodes, int(leaf)).x;
    uvec3 faces_of_leaf = texelFetch(tree_nodes, int(node)).xyz;
    uint own = texelFetch(faces, int(faces_of_leaf.y)).w;
    Bounds box = tree_bounds(node);
    PairRow row = pair_rows[own];
    bool is_empty = first_parts(faces_of_leaf.y) == first_parts(faces_of_leaf.y + faces_of_leaf.z);

    uint place_of_own = kNone;
    uint last = row.pair_count;
#ifdef OWN
    place_of_own = 0u;
    while (place_of_own < row.pair_count && object_pairs[row.first_pair + place_of_own].other < own) ++place_of_own;
    ++last;
#endif
    if (is_empty) last = 0u;
    uint count = 0u;
    for (uint k = 0u; k < last; ++k) {
        BoundingBox other = bounding_boxes[nth_object(row, own, place_of_own, k)];
        count += uint(meet(box, Bounds(other.min.xyz, other.max.xyz)));
    }
    uint left_over;
    uint first = take_slots(kNearObjects, count, near_object_capacity, left_over);
    for (uint k = 1u; k <= left_over; ++k) near_objects[near_object_capacity - k] = NearObject(kNone, 0u, 0u, 0u);
    if (first == kNone) count = 0u;
    searches[leaf] = LeafSearch(first, count, 0u, 0u, 0u, 0u, 0u, 0u);
    if (count == 0u) return;
    uint place = first;
    for (uint k = 0u; k < last; ++k) {
        uint object = nth_object(row, own, place_of_own, k);
        BoundingBox other = bounding_boxes[object];
        if (meet(box, Bounds(other.min.xyz, other.max.xyz))) near_objects[place++] = NearObject(leaf, object, 0u, 0u);
    }
}
