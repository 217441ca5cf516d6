// What colours show of each tet, one invocation a tet (docs/physics.md, "What colours show"): with STRETCH its largest
// principal stretch, with STRESS von Mises' stress [Pa], else the mean speed of its corners [m/s]. Counts them by their
// size, too, so that the range of colours can follow. Test: tests/gpu/view/tet_values_test.cpp.
#include "include/global_index.glsl"
#include "layouts/packing.glsl"
#include "sim/view/principal_stretches.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;       // xyz [m]
uniform samplerBuffer velocities;      // xyz [m/s]
uniform usamplerBuffer tets;           // nodes
uniform samplerBuffer rest_positions;  // xyz [m]
uniform samplerBuffer tet_materials;   // volume at rest [m^3], shear modulus [Pa]
layout(std430) writeonly buffer TetValues { float tet_values[]; };
layout(std430) buffer Histogram { uint histogram[]; };
uniform uint tet_count;
uniform float least;  // what is counted from

// Of the bits of a float as many as tell numbers apart that differ by a sixteenth; as in src/gpu/view/tet_values.h.

vec3 corner(samplerBuffer places, uint node) { return texelFetch(places, int(node)).xyz; }

mat3 edges(samplerBuffer places, uvec4 tet) {
    vec3 a = corner(places, tet.x);
    return mat3(corner(places, tet.y) - a, corner(places, tet.z) - a, corner(places, tet.w) - a);
}

float speed(uint node) { return length(corner(velocities, node)); }

float value_of(uint t, uvec4 tet) {
#if defined(STRETCH) || defined(STRESS)
    vec3 stretches = principal_stretches(edges(positions, tet) * inverse(edges(rest_positions, tet)));
#ifdef STRETCH
    return stretches.x;
#else
    vec3 differences = stretches - stretches.yzx;
    return texelFetch(tet_materials, int(t)).y * sqrt(2.0 * dot(differences, differences));
#endif
#else
    return 0.25 * (speed(tet.x) + speed(tet.y) + speed(tet.z) + speed(tet.w));
#endif
}

void main() {
    uint t = global_index();
    if (t >= tet_count) return;
    float value = value_of(t, texelFetch(tets, int(t)));
    tet_values[t] = value;
    atomicAdd(histogram[min(floatBitsToUint(max(value - least, 0.0)) >> kBinShift, kBins - 1u)], 1u);
}
