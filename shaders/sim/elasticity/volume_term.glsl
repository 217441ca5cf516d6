// The volume round each node, for the volume term (src/model/elasticity/volume_term.h). At `positions`, a buffer texture that is
// declared before. CPU twin: src/cpu/elasticity/volume_term.h.
#include "layouts/packing.glsl"

uniform usamplerBuffer volume_corners;  // TetCorner, in slices of 64 nodes
uniform usamplerBuffer volume_starts;   // of the slices
uniform samplerBuffer node_volumes;    // V_i [m^3], kappa_i [Pa]

// J_n, over the volume at rest; 1 where there is none. Slices are padded with tets without volume.
float volume_ratio_round(uint n) {
    vec3 at = texelFetch(positions, int(n)).xyz;
    float sum = 0.0;  // 24 times the volume
    uint end = texelFetch(volume_starts, int(n / kSlice) + 1).x;
    for (uint e = texelFetch(volume_starts, int(n / kSlice)).x + n % kSlice; e < end; e += kSlice) {
        uvec4 tet = texelFetch(volume_corners, int(e));
        vec3 a = texelFetch(positions, int(tet.x)).xyz;
        vec3 b = texelFetch(positions, int(tet.y)).xyz, c = texelFetch(positions, int(tet.z)).xyz;
        sum += dot(at - a, cross(b - a, c - a));
    }
    float rest = texelFetch(node_volumes, int(n)).x;
    return rest > 0.0 ? sum / (24.0 * rest) : 1.0;
}

// phi(J - 1).
float volume_potential(float ratio, float kappa) {
    float u = ratio - 1.0, s = min(4.0 * u * u, 1.0);
    return kappa >= 0.0 ? 0.5 * u * u : s * (3.0 - 3.0 * s + s * s) / 24.0;
}
