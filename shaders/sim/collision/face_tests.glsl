// How the tests of pairs are dealt out, and where the pairs of faces go whose boxes meet. With hierarchy a test is a walk of
// a candidate through the other object's tree, else a candidate and a block of the other object's faces.
uniform uint walk_trees;

// Long blocks for large objects, so that tests can be counted.
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
