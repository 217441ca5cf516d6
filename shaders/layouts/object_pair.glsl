// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Objects that may touch, as one of the two sees it: each pair is there twice, once in either object's row.
struct ObjectPair {      // 32 bytes
    uint  object;
    uint  other;
    uint  first_word;       // of the object's Face Collision Result for this pair: two bits a face in face_collisions
    uint  first_candidate;  // of its candidates; kAllFaces: every face is one
    uint  candidate_count;
    uint  first_test;       // tests of the pairs before this one
    uint  unused_0;
    uint  unused_1;
};
// An object's row of object_pairs, in the order of the others' indices.
struct PairRow {         // 16 bytes
    uint  first_pair;
    uint  pair_count;
    uint  first_word;    // its pairs have as many words each as its faces need
    uint  first_entry;   // an entry is four faces, a leaf, of a pair
};
// Two faces whose boxes meet.
struct FacePair {        // 16 bytes
    uint  pair;          // the ObjectPair in whose object `face` is
    uint  face;
    uint  other_face;
    uint  unused;
};
