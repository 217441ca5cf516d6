// Marks the nodes of all tets so flat that they resist, with the number of this marking, so that earlier marks need no
// clearing. VOLUME: keeps the share of its volume that each tet has, too.
// CPU twin: gelatin::cpu::FlatTets. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "sim/elasticity/node_terms.glsl"
#include "sim/elasticity/volume_ratio.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer NearFlat { uint near_flat[]; };
#ifdef VOLUME
layout(std430) writeonly buffer Ratios { float ratios[]; };  // J
#endif
uniform uint tet_count;
uniform uint mark;  // from 1

void main() {
    uint t = global_index();
    if (t >= tet_count) return;
    float ratio = volume_ratio(t);
#ifdef VOLUME
    ratios[t] = ratio;
#endif
    if (ratio >= kFlattest) return;
    uvec4 tet = texelFetch(tets, int(t));
    for (int k = 0; k < 4; ++k) near_flat[tet[k]] = mark;
}
