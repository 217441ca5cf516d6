// The buffers that the stages of collision share (src/gpu/collision_buffers.h), and what is found through them.
#include "include/global_index.glsl"
#include "layouts/box.glsl"
#include "layouts/dispatch.glsl"
#include "layouts/object_pair.glsl"

layout(std430, binding = 0) buffer BoundingBoxes { BoundingBox bounding_boxes[]; };
layout(std430, binding = 1) buffer PairRows { PairRow pair_rows[]; };
layout(std430, binding = 2) buffer ObjectPairs { ObjectPair object_pairs[]; };
layout(std430, binding = 6) buffer Dispatches { Dispatch dispatches[]; };

// Indices into dispatches. Losses are no dispatch: its count grows by what did not fit into a buffer.
const uint kEntries = 0u;    // an invocation four faces of a pair
const uint kTests = 1u;      // an invocation a candidate, and a block of the other object's faces
const uint kFacePairs = 2u;  // an invocation a pair of faces
const uint kPairs = 3u;      // an invocation a pair of objects
const uint kPairGroups = 4u; // a work group a pair of objects
const uint kNodes = 5u;      // an invocation a node
const uint kScan = 6u;       // one work group, if there are any pairs
const uint kLosses = 7u;

const uint kNone = 0xFFFFFFFFu;
const uint kAllFaces = 0xFFFFFFFFu;  // ObjectPair::first_candidate

// Work groups of 64 for `count` invocations, folded into two dimensions where one is not enough.
Dispatch make_dispatch(uint count, uint groups) {
    uint rows = (groups + 65534u) / 65535u;
    return Dispatch(rows > 0u ? (groups + rows - 1u) / rows : 0u, max(rows, 1u), 1u, count);
}
Dispatch dispatch_invocations(uint count) { return make_dispatch(count, count / 64u + uint(count % 64u != 0u)); }

bool meet(vec3 min_a, vec3 max_a, vec3 min_b, vec3 max_b) {
    return all(lessThanEqual(min_a, max_b)) && all(lessThanEqual(min_b, max_a));
}

uint word_count(uint object) { return (bounding_boxes[object].face_count + 31u) / 32u; }

uint leaf_count(uint object) { return (bounding_boxes[object].face_count + 3u) / 4u; }

// A pair is tested once, from the object with fewer faces.
bool starts_tests(ObjectPair pair) {
    uint ours = bounding_boxes[pair.object].face_count;
    uint theirs = bounding_boxes[pair.other].face_count;
    return ours < theirs || (ours == theirs && pair.object < pair.other);
}

// The pair as `object` sees it, or kNone.
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
