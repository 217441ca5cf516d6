// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// How packed arrays and bit fields are laid out.
const uint kSlice = 64u;               // rows of a slice of HalfSprings, NodeTetSlices and TetCorners
const uint kNone = 0xFFFFFFFFu;        // pads lists; an index of nothing
const uint kFacesAWord = 16u;          // of the Face Collision Result, two bits each
const uint kQueriesAGroup = 4096u;     // of proximities, that one work group of sum_proximities sums up
const uint kBinShift = 19u;            // of values' bits in the histogram of tet values
const uint kBins = 4096u;              // of that histogram
const uint kChunksOfSmallIsland = 4u;  // of up to 256 nodes: what a work group solves by itself in shared memory
