// The volume term: NODES: its stress round each node, from the volumes of the tets round it; without: of each tet the mean
// of its corners', less what its own change of volume answers for.
// CPU twin: gelatin::cpu::VolumeBounds. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "sim/elasticity/node_terms.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer tets;        // nodes
uniform samplerBuffer tet_rests;   // volume [m^3], modulus [Pa], stiffness of the volume term [Pa]
layout(std430) readonly buffer Ratios { float ratios[]; };  // J, of each tet
uniform uint element_count;

#ifdef NODES
uniform samplerBuffer node_volumes;       // V_i [m^3], kappa_i [Pa]
uniform usamplerBuffer node_tet_starts;
uniform usamplerBuffer node_tets;         // 4 tet + corner
layout(std430) writeonly buffer Pressures { float pressures[]; };  // [Pa], of each node

void main() {
    uint n = global_index();
    if (n >= element_count) return;
    float volume = 0.0;
    uint end = texelFetch(node_tet_starts, int(n) + 1).x;
    for (uint e = texelFetch(node_tet_starts, int(n)).x; e < end; ++e) {
        uint t = texelFetch(node_tets, int(e)).x / 4u;
        volume += 0.25 * ratios[t] * texelFetch(tet_rests, int(t)).x;
    }
    vec2 rest = texelFetch(node_volumes, int(n)).xy;
    pressures[n] = rest.x > 0.0 ? volume_stress(volume / rest.x, rest.y) : 0.0;
}
#else
layout(std430) readonly buffer Pressures { float pressures[]; };  // [Pa], of each node
layout(std430) writeonly buffer Offsets { float offsets[]; };     // of each tet's bound [J]

void main() {
    uint t = global_index();
    if (t >= element_count) return;
    uvec4 tet = texelFetch(tets, int(t));
    float sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += pressures[tet[k]];
    vec3 rest = texelFetch(tet_rests, int(t)).xyz;
    offsets[t] = rest.x * (0.25 * sum - rest.z * ratios[t]);
}
#endif
