// Who tests what, and the list of pairs of faces whose boxes meet.
layout(std430) readonly buffer FaceBoxes { Box face_boxes[]; };
layout(std430) readonly buffer Candidates { uint candidates[]; };
layout(std430) writeonly buffer FacePairs { FacePair face_pairs[]; };
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
    uint slot = take_slot(kFacePairs, face_pair_capacity);
    if (slot != kNone) face_pairs[slot] = face_pair;
}

bool meets_face(Box box, uint face) {
    Box other = face_boxes[face];
    return meet(box.min.xyz, box.max.xyz, other.min.xyz, other.max.xyz);
}

// Faces first, first + 1, ... whose bits are set in `found`.
void add_face_pairs(uint p, uint face, uint first, uint found) {
    while (found != 0u) {
        add_face_pair(FacePair(p, face, first + uint(findLSB(found)), 0u));
        found &= found - 1u;
    }
}
