// The volume term's stress around each node, before a pass of an explicit scheme. CPU twin: gelatin::cpu::find_volume_stresses.
// Parity: tests/gpu/elasticity/volume_term_test.cpp.
#include "include/global_index.glsl"
#include "sim/elasticity/node_terms.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;  // xyz [m], inverse mass [1/kg]
#include "sim/elasticity/volume_term.glsl"
layout(std430) writeonly buffer Stresses { float stresses[]; };  // [Pa]
uniform uint node_count;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    stresses[n] = volume_stress(volume_ratio_round(n), texelFetch(node_volumes, int(n)).y);
}
