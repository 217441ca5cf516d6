// One invocation owns one node: it gathers the forces of its springs and tets and moves, and writes the node once. No atomics, a fixed
// order of summation, so the same input gives the same bits on one driver. A work group is a slice of HalfSprings
// (src/model/model.h): all its lanes run the same number of times, over neighbouring texels.
// CPU twin: gelatin::cpu::advance_nodes. Parity: tests/gpu/explicit/advance_nodes_test.cpp.
#include "layouts/packing.glsl"
#include "sim/elasticity/strip.glsl"
#include "sim/elasticity/volume_stresses.glsl"
#include "include/global_index.glsl"
#include "sim/explicit/integrate_node.glsl"
#include "sim/elasticity/spring_force.glsl"
#ifdef NEO_HOOKEAN
#include "sim/elasticity/neo_hookean_force.glsl"
#endif
#ifdef VOLUME
#include "sim/elasticity/volume_force.glsl"
#endif
layout(local_size_x = 64) in;

uniform usamplerBuffer half_springs;  // HalfSpringPair
uniform samplerBuffer stiffnesses;    // of the pair [N/m]
uniform usamplerBuffer slice_starts;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec4 position = texelFetch(positions, int(n));
    vec4 velocity = texelFetch(velocities, int(n));
    int slice = int(n / kSlice);
    uint end = texelFetch(slice_starts, slice + 1).x;
    vec3 force = vec3(0.0);
    for (uint p = texelFetch(slice_starts, slice).x + n % kSlice; p < end; p += kSlice) {
        uvec4 pair = texelFetch(half_springs, int(p));
        vec2 stiffness = texelFetch(stiffnesses, int(p)).xy;
        force += spring_force(position, texelFetch(positions, int(pair.x)), velocity,
                              texelFetch(velocities, int(pair.x)), uintBitsToFloat(pair.y), stiffness.x);
        force += spring_force(position, texelFetch(positions, int(pair.z)), velocity,
                              texelFetch(velocities, int(pair.z)), uintBitsToFloat(pair.w), stiffness.y);
    }
#ifdef NEO_HOOKEAN
    force += gather_tet_forces(n, position.xyz, velocity);
#endif
#ifdef VOLUME
    force += gather_volume_forces(n);
#endif
    integrate_node(n, velocity, force);
}
