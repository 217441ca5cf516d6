// The paper's Face Collision Result: for each pair of objects a bit a face of the pair's object.
layout(std430, binding = 4) buffer FaceCollisions { uint face_collisions[]; };

bool collides(ObjectPair pair, uint face) {
    uint index = face - bounding_boxes[pair.object].first_face;
    return (face_collisions[pair.first_word + index / 32u] >> (index % 32u) & 1u) != 0u;
}

// In any pair of its object's row.
bool collides_with_any(PairRow row, uint face) {
    bool any = false;
    for (uint k = 0u; k < row.pair_count; ++k) any = any || collides(object_pairs[row.first_pair + k], face);
    return any;
}
