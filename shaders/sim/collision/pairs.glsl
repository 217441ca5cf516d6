// The buffers that the stages of collision share (src/gpu/collision/collision_buffers.h), and what is found through them.
// What a shader writes of them it says before: WRITES_PAIR_ROWS, for example. All else is read only.
#include "sim/collision/dispatches.glsl"
#include "include/global_index.glsl"
#include "layouts/box.glsl"
#include "layouts/object_pair.glsl"

layout(std430) readonly buffer BoundingBoxes { BoundingBox bounding_boxes[]; };
#ifdef WRITES_PAIR_ROWS
layout(std430) buffer PairRows { PairRow pair_rows[]; };
#else
layout(std430) readonly buffer PairRows { PairRow pair_rows[]; };
#endif
#ifdef WRITES_OBJECT_PAIRS
layout(std430) buffer ObjectPairs { ObjectPair object_pairs[]; };
#else
layout(std430) readonly buffer ObjectPairs { ObjectPair object_pairs[]; };
#endif

const uint kAllFaces = 0xFFFFFFFFu;  // ObjectPair::first_candidate


uint word_count(uint object) { return (bounding_boxes[object].face_count + kFacesAWord - 1u) / kFacesAWord; }

uint leaf_count(uint object) { return (bounding_boxes[object].face_count + 3u) / 4u; }

// A pair is tested once, from the object with fewer faces.
bool starts_tests(ObjectPair pair) {
    uint ours = bounding_boxes[pair.object].face_count;
    uint theirs = bounding_boxes[pair.other].face_count;
    return ours < theirs || (ours == theirs && pair.object < pair.other);
}

// The same pair as seen from `object`, or kNone.
uint find_pair(uint object, uint other) {
    PairRow row = pair_rows[object];
    uint first = row.first_pair;
    uint last = first + row.pair_count;
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (object_pairs[middle].other < other) {
            first = middle + 1u;
        } else {
            last = middle;
        }
    }
    return first < row.first_pair + row.pair_count && object_pairs[first].other == other ? first : kNone;
}
