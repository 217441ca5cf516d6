// How tests of pairs are assigned to invocations, and the list of pairs of faces whose boxes meet. With hierarchy a test is a
// walk of a candidate through the other object's tree; otherwise it is a candidate and a block of the other object's faces.
uniform uint walk_trees;

// Longer blocks for large objects, so that the number of tests does not overflow.
uint block_size(ObjectPair pair) {
    uint other_count = bounding_boxes[pair.other].face_count;
    uint size = 64u;
    while (pair.candidate_count / size * (other_count / size) > (1u << 10)) size *= 4u;
    return size;
}

uint count_tests(ObjectPair pair) {
    if (!starts_tests(pair)) return 0u;
    if (walk_trees != 0u) return pair.candidate_count;
    uint size = block_size(pair);
    return pair.candidate_count * ((bounding_boxes[pair.other].face_count + size - 1u) / size);
}
