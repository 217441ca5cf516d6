// The rounding of single precision, in which the predicates' bounds are given.
#include "layouts/predicates.glsl"

const float kEpsilon = 1.1920929e-7;           // 2^-23
const float kLeastNormal = 1.17549435e-38;     // 2^-126
const float kUnderflowBound = float(kUnderflowRounding) * kLeastNormal / kEpsilon;
