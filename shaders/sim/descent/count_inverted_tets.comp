// How many tets of each object are inside out, or have no volume left.
// CPU twin: gelatin::cpu::ShapeMatcher. Parity: tests/gpu/descent/match_shapes_test.cpp.
#include "include/global_index.glsl"
#include "sim/elasticity/volume_ratio.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer node_objects;
layout(std430) buffer Inverted { uint inverted[]; };  // by object
uniform uint tet_count;

void main() {
    uint t = global_index();
    if (t >= tet_count || volume_ratio(t) > 0.0) return;
    atomicAdd(inverted[texelFetch(node_objects, int(texelFetch(tets, int(t)).x)).x], 1u);
}
