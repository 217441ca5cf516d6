// The faces of each pair's object that may collide and reach into the other's box, in no particular order, where its tests
// start; and a Face Collision Result without collisions. One invocation an entry: four faces of a pair. CPU twin: gelatin::cpu::Collision.
// Parity: tests/gpu/collision/collision_test.cpp.
#define WRITES_OBJECT_PAIRS
#define WRITES_FACE_COLLISIONS
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_collisions.glsl"
#include "sim/collision/may_collide.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer FaceBoxes { Box face_boxes[]; };
layout(std430) writeonly buffer Candidates { uint candidates[]; };
uniform uint object_count;

// The last object whose entries start at or before `entry`; rows without entries are skipped.
uint object_of_entry(uint entry) {
    uint first = 0u;
    uint last = object_count;
    while (last - first > 1u) {
        uint middle = (first + last) / 2u;
        if (pair_rows[middle].first_entry <= entry) {
            first = middle;
        } else {
            last = middle;
        }
    }
    return first;
}

void main() {
    uint entry = global_index();
    if (entry >= dispatches[kEntries].count) return;
    uint object = object_of_entry(entry);
    PairRow row = pair_rows[object];
    BoundingBox own = bounding_boxes[object];
    uint leaves = leaf_count(object);
    uint p = row.first_pair + (entry - row.first_entry) / leaves;
    uint leaf = (entry - row.first_entry) % leaves;
    ObjectPair pair = object_pairs[p];

    if (leaf % 4u == 0u) face_collisions[pair.first_word + leaf / 4u] = 0u;
    if (pair.first_candidate == kAllFaces || !starts_tests(pair)) return;
    BoundingBox other = bounding_boxes[pair.other];
    uint end = own.first_face + min(4u * leaf + 4u, own.face_count);
    for (uint face = own.first_face + 4u * leaf; face < end; ++face) {
        Box box = face_boxes[face];
        if (!meet(box.min.xyz, box.max.xyz, other.min.xyz, other.max.xyz) || !face_may_collide(face)) continue;
        candidates[pair.first_candidate + atomicAdd(object_pairs[p].candidate_count, 1u)] = face;
    }
}
