// The paper's way, first kernel (3.3): each spring writes the force on its first endpoint. As in the paper, everything
// is a storage buffer; the fused kernel gathers through textures instead.
// CPU twin: gelatin::cpu::write_spring_forces. Parity: tests/gpu/explicit/divide_and_merge_test.cpp.
#include "include/global_index.glsl"
#include "sim/elasticity/spring_force.glsl"
#include "layouts/spring.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer Positions { vec4 node_positions[]; };    // xyz [m], inverse mass [1/kg]
layout(std430) readonly buffer Velocities { vec4 node_velocities[]; };  // xyz [m/s], damping time [s]
layout(std430) readonly buffer Springs { Spring springs[]; };
layout(std430) writeonly buffer SpringForces { vec4 spring_forces[]; };     // [N]
uniform uint spring_count;

void main() {
    uint s = global_index();
    if (s >= spring_count) return;
    Spring spring = springs[s];
    vec3 force = spring_force(node_positions[spring.i], node_positions[spring.j], node_velocities[spring.i],
                              node_velocities[spring.j], spring.rest_length, spring.stiffness);
    spring_forces[s] = vec4(force, 0.0);
}
