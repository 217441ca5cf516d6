// The counts of inverted tets, all zero before a step. Read only where WRITES_INVERTED is not defined.
#include "layouts/dispatch.glsl"
#include "layouts/shape_match.glsl"

layout(std430) readonly buffer RestMoments { RestMoment rest_moments[]; };
#ifdef WRITES_INVERTED
layout(std430) buffer Inverted {
#else
layout(std430) readonly buffer Inverted {
#endif
    Dispatch match_dispatches[2];  // of match_shapes.comp without OBJECTS, of place_shapes.comp
    uint inverted[];               // tets, by object
};

// An object of which more tets are inverted may have lost its shape.
uint most_inverted(uint object) { return uint(rest_moments[object].inverse_y.w); }
