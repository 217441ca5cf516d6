// How the tests of a pair of objects are dealt out: an invocation has a candidate of one and a block of the other's.

// Long blocks for large objects, so that tests can be counted.
uint block_size(ObjectPair pair, uint other_count) {
    uint size = 64u;
    while (pair.candidate_count / size * (other_count / size) > (1u << 10)) size *= 4u;
    return size;
}

uint block_count(ObjectPair pair, uint other_count) {
    uint size = block_size(pair, other_count);
    return (other_count + size - 1u) / size;
}
