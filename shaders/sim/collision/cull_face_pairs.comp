// Brute force: the pairs of faces whose boxes meet, in no particular order. CPU twin: gelatin::cpu::Collision. Parity:
// tests/gpu/collision/collision_test.cpp.
#define WRITES_DISPATCHES
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_pairs.glsl"
#include "sim/collision/face_tests.glsl"
layout(local_size_x = 64) in;

void main() {
    uint test = global_index();
    if (test >= dispatches[kTests].count) return;
    uint p = pair_of_test(test);
    ObjectPair pair = object_pairs[p];
    BoundingBox other = bounding_boxes[pair.other];
    uint index = test - pair.first_test;
    uint face = candidate(pair, index % pair.candidate_count);
    uint size = block_size(pair);
    uint first = index / pair.candidate_count * size;
    uint last = min(first + size, other.face_count);

    Box box = face_boxes[face];
    for (uint start = first; start < last; start += 32u) {
        // Tests first, without branches, then the list of those that passed.
        uint found = 0u;
        for (uint k = 0u; k < 32u; ++k) {
            bool near = meets_face(box, other.first_face + min(start + k, last - 1u));
            found |= uint(near && start + k < last) << k;
        }
        add_face_pairs(p, face, other.first_face + start, found);
    }
}
