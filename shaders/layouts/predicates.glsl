// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// What decides in the geometric predicates. Rounding bounds are in units of the type's epsilon, and explained in
// src/cpu/collision/triangle_overlap.h, time_of_impact.h and nearest_points.h.
const uint kOverlapRounding = 8u;
const uint kImpactRounding = 8u;
const uint kRootRounding = 8u;
const uint kParallelRounding = 4u;
const uint kUnderflowRounding = 16u;   // of the least normal number over epsilon
const int kMostPlanes = 32;            // that a search for the time of impact tries
