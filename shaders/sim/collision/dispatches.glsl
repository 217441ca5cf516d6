// What the GPU itself has counted, as the arguments of indirect dispatches (src/gpu/collision/collision_buffers.h).
#include "layouts/dispatch.glsl"

#ifdef WRITES_DISPATCHES
layout(std430, binding = 6) buffer Dispatches { Dispatch dispatches[]; };
#else
layout(std430, binding = 6) readonly buffer Dispatches { Dispatch dispatches[]; };
#endif

// Indices into dispatches. Losses are no dispatch: its count grows by what did not fit into a buffer.
const uint kEntries = 0u;    // an invocation four faces of a pair
const uint kTests = 1u;      // an invocation a candidate, and a block of the other object's faces
const uint kFacePairs = 2u;  // an invocation a pair of faces
const uint kPairs = 3u;      // an invocation a pair of objects
const uint kPairGroups = 4u; // a work group a pair of objects
const uint kNodes = 5u;      // an invocation a node
const uint kScan = 6u;       // one work group, if there are any pairs
const uint kLosses = 7u;
const uint kRestless = 8u;   // an invocation a face that walks through its object's own tree
const uint kSelfPairs = 9u;  // an invocation a pair of faces of one object
const uint kSelfFaces = 10u; // an invocation a face that touches another of its object
const uint kSelfNodes = 11u; // an invocation a node
const uint kFitSums = 12u;   // a work group a chunk of nodes of an object that may have restless faces
const uint kFits = 13u;      // an invocation such an object
const uint kRestlessChunks = 14u;  // a work group a chunk of its faces
const uint kNearObjects = 15u; // an invocation a leaf's walk through the tree of an object
const uint kNearLeaves = 16u;  // no dispatch: how many leaves they have found
const uint kNodeTasks = 17u;   // an invocation a node and up to eight of them
const uint kEdgeTasks = 18u;   // an invocation an edge and up to eight of them

// Work groups of 64 for `count` invocations, folded into two dimensions where one is not enough.
Dispatch make_dispatch(uint count, uint groups) {
    uint rows = (groups + 65534u) / 65535u;
    return Dispatch(rows > 0u ? (groups + rows - 1u) / rows : 0u, max(rows, 1u), 1u, count);
}
Dispatch dispatch_invocations(uint count) { return make_dispatch(count, count / 64u + uint(count % 64u != 0u)); }

const uint kNone = 0xFFFFFFFFu;

#ifdef WRITES_DISPATCHES
// The place of one more element in a list that a dispatch will go through, or kNone where it is full: a loss.
uint take_slot(uint work, uint capacity) {
    uint slot = atomicAdd(dispatches[work].count, 1u);
    if (slot >= capacity) {
        atomicAdd(dispatches[kLosses].count, 1u);
        return kNone;
    }
    if (slot % 64u == 0u) atomicAdd(dispatches[work].groups_x, 1u);
    return slot;
}

// The first of `count` more places in a list, or kNone where they do not fit: losses. Places that are left over then, the
// last `left_over` ones, are for the caller to mark as empty.
uint take_slots(uint work, uint count, uint capacity, out uint left_over) {
    left_over = 0u;
    if (count == 0u) return kNone;
    // A list that is full is not added to, so that its count does not run over.
    uint first = max(dispatches[work].count, count) > capacity ? kNone : atomicAdd(dispatches[work].count, count);
    if (first > capacity - min(count, capacity)) {
        atomicAdd(dispatches[kLosses].count, count);
        left_over = capacity - min(first, capacity);
        return kNone;
    }
    atomicMax(dispatches[work].groups_x, (first + count + 63u) / 64u);
    return first;
}
#endif

bool meet(vec3 min_a, vec3 max_a, vec3 min_b, vec3 max_b) {
    return all(lessThanEqual(min_a, max_b)) && all(lessThanEqual(min_b, max_a));
}
