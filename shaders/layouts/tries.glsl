// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// Indices into the arguments of the indirect dispatches of a try (gpu::Tries). First those of pair_stages.glsl and others that the
// device counts; then two of each number of work groups that the host knows: where the try makes a part, and where it goes on at all.
const uint kPressedPairs = 10u;  // a work group a pair of the tables of rows
const uint kRows = 11u;          // an invocation a row
const uint kGuardRound = 12u;    // two a round: of its pairs; of the next one's nodes
const uint kGuardStays = 29u;    // an invocation a node
const uint kFirstSize = 30u;
const uint kMostSizes = 17u;
const uint kTryDispatches = 64u;
