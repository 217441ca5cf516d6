// Bodies that the first guess tangles start where they were: it can hold any energy, which few sweeps would not take out
// again. TETS: finds them; without: puts their nodes back.
// CPU twin: gelatin::cpu::BlockDescent. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "layouts/thresholds.glsl"
#include "include/global_index.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer node_objects;
uniform uint element_count;

#ifdef TETS
#include "sim/elasticity/volume_ratio.glsl"

layout(std430) writeonly buffer Tangled { uint is_tangled[]; };  // by object

void main() {
    uint t = global_index();
    if (t >= element_count) return;
    float ratio = volume_ratio(t);
    if (ratio > kLeastSound && ratio < kMostSound) return;
    is_tangled[texelFetch(node_objects, int(texelFetch(tets, int(t)).x)).x] = 1u;
}
#else
uniform samplerBuffer start_positions;  // xyz [m]
layout(std430) buffer Positions { vec4 positions[]; };
layout(std430) readonly buffer Tangled { uint is_tangled[]; };  // by object

void main() {
    uint n = global_index();
    if (n >= element_count || is_tangled[texelFetch(node_objects, int(n)).x] == 0u) return;
    vec3 start = texelFetch(start_positions, int(n)).xyz;
    if (positions[n].w > 0.0) positions[n].xyz = start;  // held ones are where their handle takes them
}
#endif
