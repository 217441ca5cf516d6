// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// How sums over the nodes of a body as a rigid one are divided (sim/descent/sum_rigid_motions.comp).
const uint kRigidSums = 16u;          // dvec4s in RigidSums, sim/descent/rigid_sums.glsl
const uint kLanesAChunk = 16u;        // invocations that sum up a chunk
