// What count_inverted_tets.comp finds; all zero before it.
#include "layouts/dispatch.glsl"
#include "layouts/shape_match.glsl"

layout(std430) readonly buffer RestMoments { RestMoment rest_moments[]; };
layout(std430) buffer Inverted {
    Dispatch match_dispatches[3];  // of match_shapes.comp, of it with OBJECTS, of place_shapes.comp
    uint inverted[];               // tets, by object
};

// An object of which more tets are inside out may have lost its shape.
uint most_inverted(uint object) { return uint(rest_moments[object].inverse_y.w); }
