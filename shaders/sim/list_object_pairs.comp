// Each object's row of pairs, in the order of the others' indices. CPU twin: gelatin::cpu::Collision.
// Parity: tests/gpu/collision_test.cpp.
#include "include/object_may_touch.glsl"
layout(local_size_x = 64) in;

uniform uint all_faces;  // 1: every face of the pair is a candidate
uniform uint candidate_capacity;

void main() {
    uint a = global_index();
    if (a >= object_count) return;
    PairRow row = pair_rows[a];
    uint words = word_count(a);
    uint faces = bounding_boxes[a].face_count;
    uint leaves = leaf_count(a);
    // Where their candidates do not fit, all faces are.
    bool all = all_faces != 0u || 4u * (row.first_entry + row.pair_count * leaves) > candidate_capacity;
    uint k = 0u;
    for (uint b = 0u; b < object_count && k < row.pair_count; ++b) {
        if (!may_touch(a, b)) continue;
        object_pairs[row.first_pair + k] = ObjectPair(a, b, row.first_word + k * words,
                                                      all ? kAllFaces : 4u * (row.first_entry + k * leaves),
                                                      all ? faces : 0u, 0u, 0u, 0u);
        ++k;
    }
}
