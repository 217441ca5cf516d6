// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// Of gpu::FindPairs. A stage finds how many of the next list each element of a list has; prefix sums place them, and then they are
// written. Elements are slots, searches, leaf pairs. Two indirect dispatches a stage: of its elements, and of the sums over them.
const uint kOfSlots = 0u;
const uint kOfSearches = 1u;
const uint kOfLeafPairs = 2u;
const uint kWrites = 6u;           // an invocation as of the stage of leaf pairs: near pairs have a place
const uint kSlotEnds = 7u;         // an invocation a slot
const uint kNearPairs = 8u;        // an invocation a near pair, where rows are made of them
const uint kSlotGroups = 9u;       // a work group a slot, likewise
const uint kPairDispatches = 10u;
const uint kCountsAGroup = 1024u;  // elements that one work group sums up
const uint kLanesALeafPair = 8u;
