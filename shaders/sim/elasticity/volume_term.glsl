// The volume around each node, for the volume term (src/model/elasticity/volume_term.h). At `positions`, a buffer texture that
// must be declared before. CPU twin: src/cpu/elasticity/volume_term.h.
#include "layouts/packing.glsl"
#include "sim/elasticity/strip.glsl"

uniform usamplerBuffer volume_strips;  // VolumeStep, in slices of 64 nodes; kNone pads
uniform usamplerBuffer volume_starts;  // of the slices
uniform samplerBuffer node_volumes;    // V_i [m^3], kappa_i [Pa]

// Twice the area of a step's triangle, away from the node; 0 without a tet.
vec3 area_of(uvec4 volume_step, Strip strip) {
    return sign(uintBitsToFloat(volume_step.z)) * cross(strip.b - strip.a, strip.c - strip.a);
}

// J_n, relative to the volume at rest; 1 if there is none.
float volume_ratio_round(uint n) {
    vec3 at = texelFetch(positions, int(n)).xyz;
    float sum = 0.0;  // 24 times the volume
    Strip strip = kNoStrip;
    uint end = texelFetch(volume_starts, int(n / kSlice) + 1).x;
    for (uint e = texelFetch(volume_starts, int(n / kSlice)).x + n % kSlice; e < end; e += kSlice) {
        uvec4 volume_step = texelFetch(volume_strips, int(e));
        if (volume_step.x == kNone) break;
        step_strip(volume_step.x, texelFetch(positions, node_of(volume_step.x)).xyz - at, strip);
        sum -= dot(strip.a, area_of(volume_step, strip));
    }
    float rest = texelFetch(node_volumes, int(n)).x;
    return rest > 0.0 ? sum / (24.0 * rest) : 1.0;
}

// phi(J - 1).
float volume_potential(float ratio, float kappa) {
    float u = ratio - 1.0, s = min(4.0 * u * u, 1.0);
    return kappa >= 0.0 ? 0.5 * u * u : s * (3.0 - 3.0 * s + s * s) / 24.0;
}
