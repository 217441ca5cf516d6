// The paper's Face Collision Result: for each pair of objects two bits a face of the pair's object, how it touches the
// other (src/cpu/collision/face_contact.h).
const uint kTouches = 1u;
const uint kEnters = 3u;
#ifdef WRITES_FACE_COLLISIONS
layout(std430) buffer FaceCollisions { uint face_collisions[]; };
#else
layout(std430) readonly buffer FaceCollisions { uint face_collisions[]; };
#endif

bool collides(ObjectPair pair, uint face) {
    uint index = face - bounding_boxes[pair.object].first_face;
    return (face_collisions[pair.first_word + index / kFacesAWord] >> (2u * (index % kFacesAWord)) & kTouches) != 0u;
}

// In any pair of its object's row, or with SELF_COLLISION with its own object.
#ifdef SELF_COLLISION
layout(std430) readonly buffer ContactCounts { uint contact_counts[]; };
#endif
bool collides_with_any(PairRow row, uint face) {
#ifdef SELF_COLLISION
    bool any = contact_counts[face] > 0u;
#else
    bool any = false;
#endif
    for (uint k = 0u; k < row.pair_count; ++k) any = any || collides(object_pairs[row.first_pair + k], face);
    return any;
}
