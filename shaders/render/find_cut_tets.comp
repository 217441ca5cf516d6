// Lists the tets that a plane cuts, one invocation a tet, as an indirect draw of six vertices each. Their order
// differs from run to run, which pictures hardly show: the tets of a body share no place, unless some are inside out.
#include "render/include/cut.glsl"
#include "include/global_index.glsl"
#include "layouts/draw.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer node_positions;  // xyz [m]
uniform usamplerBuffer tets;           // nodes
layout(std430) writeonly buffer MetTets { uint met_tets[]; };
layout(std430) buffer Arguments { Draw met; };
uniform uint tet_count;

void main() {
    uint t = global_index();
    if (t >= tet_count) return;
    uvec4 tet = texelFetch(tets, int(t));
    float deepest = depth_below_cut(texelFetch(node_positions, int(tet.x)).xyz), highest = deepest;
    for (int k = 1; k < 4; ++k) {
        float depth = depth_below_cut(texelFetch(node_positions, int(tet[k])).xyz);
        deepest = max(deepest, depth);
        highest = min(highest, depth);
    }
    if (deepest >= 0.0 && highest < 0.0) met_tets[atomicAdd(met.count, 6u) / 6u] = t;
}
