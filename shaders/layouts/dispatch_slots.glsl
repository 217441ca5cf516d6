// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// Indices into the arguments of the indirect dispatches of collision. Losses are no dispatch: its count grows by what did not
// fit into a buffer.
const uint kEntries = 0u;           // an invocation four faces of a pair
const uint kTests = 1u;             // an invocation a candidate, and a block of the other object's faces
const uint kFacePairs = 2u;         // an invocation a pair of faces
const uint kPairs = 3u;             // an invocation a pair of objects
const uint kPairGroups = 4u;        // a work group a pair of objects
const uint kNodes = 5u;             // an invocation a node
const uint kScan = 6u;              // one work group, if there are any pairs
const uint kLosses = 7u;
const uint kRestless = 8u;          // an invocation a face that walks through its object's own tree
const uint kSelfPairs = 9u;         // an invocation a pair of faces of one object
const uint kSelfFaces = 10u;        // an invocation a face that touches another of its object
const uint kSelfNodes = 11u;        // an invocation a node
const uint kFitSums = 12u;          // a work group a chunk of nodes of an object that may have restless faces
const uint kFits = 13u;             // an invocation such an object
const uint kRestlessChunks = 14u;   // a work group a chunk of its faces
const uint kNearObjects = 15u;      // an invocation a leaf's walk through the tree of an object
const uint kNearLeaves = 16u;       // no dispatch: how many leaves they have found
const uint kNodeTasks = 17u;        // an invocation a node and up to eight of them
const uint kEdgeTasks = 18u;        // an invocation an edge and up to eight of them
const uint kDispatchSlots = 19u;
