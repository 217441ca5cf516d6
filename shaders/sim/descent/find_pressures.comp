// The volume term: NODES: its stress round each node, from the volumes of the tets round it; without: of each tet the mean
// of its corners', less what its own change of volume answers for.
// CPU twin: gelatin::cpu::VolumeBounds. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "layouts/packing.glsl"
#include "sim/elasticity/node_terms.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer ratios;  // J, of each tet
uniform uint element_count;

#ifdef NODES
uniform samplerBuffer node_volumes;     // V_i [m^3], kappa_i [Pa]
uniform usamplerBuffer volume_shares;   // of two tets round a node: the tet, and its share of V_i; in slices of 64 nodes
uniform usamplerBuffer share_starts;    // of the slices
layout(std430) writeonly buffer Pressures { float pressures[]; };  // [Pa], of each node

void main() {
    uint n = global_index();
    if (n >= element_count) return;
    float ratio = 0.0;
    int slice = int(n / kSlice);
    uint end = texelFetch(share_starts, slice + 1).x;
    for (uint s = texelFetch(share_starts, slice).x + n % kSlice; s < end; s += kSlice) {
        uvec4 two = texelFetch(volume_shares, int(s));
        ratio += uintBitsToFloat(two.y) * texelFetch(ratios, int(two.x)).x;
        ratio += uintBitsToFloat(two.w) * texelFetch(ratios, int(two.z)).x;
    }
    pressures[n] = volume_stress(ratio, texelFetch(node_volumes, int(n)).y);
}
#else
uniform usamplerBuffer tets;       // nodes
uniform samplerBuffer tet_rests;   // volume [m^3], modulus [Pa], stiffness of the volume term [Pa]
uniform samplerBuffer pressures;   // [Pa], of each node
layout(std430) writeonly buffer Offsets { float offsets[]; };  // of each tet's bound [J]

void main() {
    uint t = global_index();
    if (t >= element_count) return;
    uvec4 tet = texelFetch(tets, int(t));
    float sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += texelFetch(pressures, int(tet[k])).x;
    vec3 rest = texelFetch(tet_rests, int(t)).xyz;
    offsets[t] = rest.x * (0.25 * sum - rest.z * texelFetch(ratios, int(t)).x);
}
#endif
