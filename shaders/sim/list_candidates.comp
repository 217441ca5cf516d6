// The faces of each pair's object that reach into the other's box, in no particular order; and a Face Collision Result
// without collisions. One invocation an entry: a face of a pair. CPU twin: gelatin::cpu::Collision.
// Parity: tests/gpu/collision_test.cpp.
#include "include/pairs.glsl"
#include "include/face_collisions.glsl"
layout(local_size_x = 64) in;

layout(std430, binding = 3) readonly buffer FaceBoxes { Box face_boxes[]; };
layout(std430, binding = 5) writeonly buffer Candidates { uint candidates[]; };
uniform uint object_count;

// The last object whose entries do not start behind `entry`: rows without entries are passed over.
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
    uint face_count = bounding_boxes[object].face_count;
    uint p = row.first_pair + (entry - row.first_entry) / face_count;
    uint index = (entry - row.first_entry) % face_count;
    ObjectPair pair = object_pairs[p];

    if (index % 32u == 0u) face_collisions[pair.first_word + index / 32u] = 0u;
    if (pair.first_candidate == kAllFaces) return;
    uint face = bounding_boxes[object].first_face + index;
    Box box = face_boxes[face];
    BoundingBox other = bounding_boxes[pair.other];
    if (!meet(box.min.xyz, box.max.xyz, other.min.xyz, other.max.xyz)) return;
    candidates[pair.first_candidate + atomicAdd(object_pairs[p].candidate_count, 1u)] = face;
}
