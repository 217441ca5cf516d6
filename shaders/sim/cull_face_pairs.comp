// The pairs of candidates whose boxes meet, in no particular order. CPU twin: gelatin::cpu::Collision.
// Parity: tests/gpu/collision_test.cpp.
#include "include/pairs.glsl"
#include "include/face_tests.glsl"
layout(local_size_x = 64) in;

layout(std430, binding = 3) readonly buffer FaceBoxes { Box face_boxes[]; };
layout(std430, binding = 5) readonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 7) writeonly buffer FacePairs { FacePair face_pairs[]; };
uniform uint face_pair_capacity;

// The last pair whose tests do not start behind `test`: pairs without tests are passed over.
uint pair_of_test(uint test) {
    uint first = 0u;
    uint last = dispatches[kScan].count;
    while (last - first > 1u) {
        uint middle = (first + last) / 2u;
        if (object_pairs[middle].first_test <= test) {
            first = middle;
        } else {
            last = middle;
        }
    }
    return first;
}

uint candidate(ObjectPair pair, uint k) {
    if (pair.first_candidate == kAllFaces) return bounding_boxes[pair.object].first_face + k;
    return candidates[pair.first_candidate + k];
}

void add_face_pair(FacePair face_pair) {
    uint slot = atomicAdd(dispatches[kFacePairs].count, 1u);
    if (slot >= face_pair_capacity) {
        atomicAdd(dispatches[kLosses].count, 1u);
        return;
    }
    face_pairs[slot] = face_pair;
    if (slot % 64u == 0u) atomicAdd(dispatches[kFacePairs].groups_x, 1u);
}

void main() {
    uint test = global_index();
    if (test >= dispatches[kTests].count) return;
    uint p = pair_of_test(test);
    ObjectPair pair = object_pairs[p];
    ObjectPair mirror = object_pairs[find_pair(pair.other, pair.object)];
    uint index = test - pair.first_test;
    uint face = candidate(pair, index % pair.candidate_count);
    uint size = block_size(pair, mirror.candidate_count);
    uint first = index / pair.candidate_count * size;
    uint last = min(first + size, mirror.candidate_count);

    Box box = face_boxes[face];
    for (uint start = first; start < last; start += 32u) {
        // Tests first, without branches, then what they found.
        uint found = 0u;
        for (uint k = 0u; k < 32u; ++k) {
            uint other = candidate(mirror, min(start + k, last - 1u));
            Box other_box = face_boxes[other];
            bool near = meet(box.min.xyz, box.max.xyz, other_box.min.xyz, other_box.max.xyz);
            found |= uint(near && start + k < last) << k;
        }
        while (found != 0u) {
            uint k = uint(findLSB(found));
            found &= found - 1u;
            add_face_pair(FacePair(p, face, candidate(mirror, start + k), 0u));
        }
    }
}
