// Each object's row of pairs, in the order of the others' indices. CPU twin: gelatin::cpu::Collision. Parity:
// tests/gpu/collision/collision_test.cpp.
#define WRITES_OBJECT_PAIRS
#include "sim/collision/object_may_touch.glsl"
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
    // If their candidates do not fit, all faces are candidates.
    bool all = all_faces != 0u || 4u * (row.first_entry + row.pair_count * leaves) > candidate_capacity;
    Search search = start_search(a);
    for (uint k = 0u; k < row.pair_count; ++k) {
        uint other = next_partner(search);
        // Inserted in order among those found before.
        uint place = row.first_pair + k;
        while (place > row.first_pair && object_pairs[place - 1u].other > other) {
            object_pairs[place].other = object_pairs[place - 1u].other;
            --place;
        }
        object_pairs[place].other = other;
    }
    for (uint k = 0u; k < row.pair_count; ++k) {
        uint p = row.first_pair + k;
        object_pairs[p] = ObjectPair(a, object_pairs[p].other, row.first_word + k * words,
                                     all ? kAllFaces : 4u * (row.first_entry + k * leaves), all ? faces : 0u, 0u, 0u, 0u);
    }
}
