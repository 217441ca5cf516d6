// Looks at each tet: marks the nodes of those so flat that they resist; VOLUME: and keeps how much of its volume is there.
// CPU twin: gelatin::cpu::TetResistance. Parity: tests/gpu/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "include/node_terms.glsl"
layout(local_size_x = 64) in;

layout(binding = 0) uniform samplerBuffer positions;    // xyz [m]
layout(binding = 9) uniform usamplerBuffer tets;        // nodes
layout(binding = 10) uniform samplerBuffer tet_rests;   // volume [m^3], modulus [Pa], stiffness of the volume term [Pa]
layout(std430, binding = 1) writeonly buffer NearFlat { uint near_flat[]; };
#ifdef VOLUME
layout(std430, binding = 3) writeonly buffer Ratios { float ratios[]; };  // J
#endif
uniform uint tet_count;

void main() {
    uint t = global_index();
    if (t >= tet_count) return;
    uvec4 tet = texelFetch(tets, int(t));
    vec3 a = texelFetch(positions, int(tet.x)).xyz;
    vec3 u = texelFetch(positions, int(tet.y)).xyz - a;
    vec3 v = texelFetch(positions, int(tet.z)).xyz - a;
    vec3 w = texelFetch(positions, int(tet.w)).xyz - a;
    float ratio = dot(cross(u, v), w) / (6.0 * texelFetch(tet_rests, int(t)).x);
#ifdef VOLUME
    ratios[t] = ratio;
#endif
    if (ratio >= kFlattest) return;
    for (int k = 0; k < 4; ++k) near_flat[tet[k]] = 1u;
}
