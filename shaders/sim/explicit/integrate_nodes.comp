// The paper's third kernel (3.3): each node moves by its merged forces, and those of its tets. CPU twin:
// gelatin::cpu::integrate_nodes. Parity: tests/gpu/explicit/divide_and_merge_test.cpp.
#include "layouts/packing.glsl"
#include "sim/elasticity/strip.glsl"
#include "sim/elasticity/volume_stresses.glsl"
#include "include/global_index.glsl"
#include "sim/explicit/integrate_node.glsl"
#ifdef NEO_HOOKEAN
#include "sim/elasticity/neo_hookean_force.glsl"
#endif
#ifdef VOLUME
#include "sim/elasticity/volume_force.glsl"
#endif
layout(local_size_x = 64) in;

layout(std430) readonly buffer NodeForces { vec4 node_forces[]; };  // [N]

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec3 force = node_forces[n].xyz;
#ifdef NEO_HOOKEAN
    force += gather_tet_forces(n, texelFetch(positions, int(n)).xyz, texelFetch(velocities, int(n)));
#endif
#ifdef VOLUME
    force += gather_volume_forces(n);
#endif
    integrate_node(n, texelFetch(velocities, int(n)), force);
}
