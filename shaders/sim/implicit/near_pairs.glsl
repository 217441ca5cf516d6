// Pairs of surfaces that are near each other in a part, and their slots.
// CPU twin: gelatin::cpu::FindPairs.
#include "layouts/near_pair.glsl"
#include "layouts/packing.glsl"
#include "layouts/pair_rows.glsl"
#include "layouts/step_state.glsl"

uniform usamplerBuffer near_pairs;   // NearPair, five texels each
uniform usamplerBuffer pair_slots;   // PairSlot, a texel each
uniform uint body_count;
layout(std430) readonly buffer Counts { PairCounts counts[]; };

bool is_body(uint object) { return object < body_count; }

NearPair fetch_pair(uint p) {
    int at = 5 * int(p);
    uvec4 nodes = texelFetch(near_pairs, at), sides = texelFetch(near_pairs, at + 3), rest = texelFetch(near_pairs, at + 4);
    return NearPair(nodes.x, nodes.y, nodes.z, nodes.w, uintBitsToFloat(texelFetch(near_pairs, at + 1)),
                    uintBitsToFloat(texelFetch(near_pairs, at + 2)), sides.x, sides.y, sides.z, sides.w, rest.x, rest.y,
                    uintBitsToFloat(rest.z), uintBitsToFloat(rest.w));
}

uvec4 nodes_of(NearPair near) { return uvec4(near.node_0, near.node_1, near.node_2, near.node_3); }

// 0 or 1.
int side_of(NearPair near, int k) { return k == 0 || (k == 1 && near.is_edges != 0u) ? 0 : 1; }
