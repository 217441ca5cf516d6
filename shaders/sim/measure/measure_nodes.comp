// Sums over nodes, one work group for each chunk; the host adds up the chunks in double precision. Pinned nodes (inverse mass
// 0) count for contacts and elastic energy only. CPU twin: gelatin::cpu::measure. Parity: tests/gpu/measure/measure_test.cpp.
#include "layouts/packing.glsl"
#include "sim/elasticity/strip.glsl"
#include "sim/collision/colliders.glsl"
#include "include/global_index.glsl"
#include "layouts/chunk.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;   // xyz [m], inverse mass [1/kg]
uniform samplerBuffer velocities;  // xyz [m/s]
uniform usamplerBuffer half_springs;
uniform samplerBuffer stiffnesses;
uniform usamplerBuffer slice_starts;
layout(std430) readonly buffer Chunks { Chunk chunks[]; };
layout(std430) writeonly buffer Sums { NodeSums node_sums[]; };
#ifdef NEO_HOOKEAN
#include "sim/elasticity/tet_walk.glsl"
#endif
#ifdef VOLUME
#include "sim/elasticity/volume_term.glsl"
#endif
uniform uint chunk_count;
uniform vec3 gravity;            // [m/s^2]
uniform samplerBuffer contact_distances;  // of each object [m]

shared NodeSums parts[64];

float half_energy(vec3 a, uint other, float rest_length, float stiffness) {
    float stretch = distance(a, texelFetch(positions, int(other)).xyz) - rest_length;
    return 0.25 * stiffness * stretch * stretch;
}

float half_spring_energy(uint n, vec3 position) {
    float energy = 0.0;
    uint end = texelFetch(slice_starts, int(n / kSlice) + 1).x;
    for (uint p = texelFetch(slice_starts, int(n / kSlice)).x + n % kSlice; p < end; p += kSlice) {
        uvec4 pair = texelFetch(half_springs, int(p));
        vec2 stiffness = texelFetch(stiffnesses, int(p)).xy;
        energy += half_energy(position, pair.x, uintBitsToFloat(pair.y), stiffness.x);
        energy += half_energy(position, pair.z, uintBitsToFloat(pair.w), stiffness.y);
    }
    return energy;
}

#ifdef NEO_HOOKEAN
// A node has a quarter of the energy of each of its tets.
float quarter_tet_energy(uint n, vec3 position) {
    float energy = 0.0;
    TetWalk walk = begin_tet_walk(n);
    while (walk_on(position, walk))
        if (walk.tet.tet != kNone) energy += 0.25 * neo_hookean_energy(walk.tet, tet_at_corner(walk.tet, walk.strip));
    return energy;
}
#endif

NodeSums measure_node(uint n, float contact_distance) {
    vec4 position = texelFetch(positions, int(n));
    vec3 velocity = texelFetch(velocities, int(n)).xyz;
    float mass = position.w > 0.0 ? 1.0 / position.w : 0.0;
    float outside = distance_to_colliders(position.xyz);
    vec3 momentum = mass * velocity;
    float elastic_energy = half_spring_energy(n, position.xyz);
#ifdef NEO_HOOKEAN
    elastic_energy += quarter_tet_energy(n, position.xyz);
#endif
#ifdef VOLUME
    vec2 rest = texelFetch(node_volumes, int(n)).xy;
    elastic_energy += rest.x * rest.y * volume_potential(volume_ratio_round(n), rest.y);
#endif
    return NodeSums(momentum.x, momentum.y, momentum.z, 0.5 * dot(momentum, velocity),
                    elastic_energy, -mass * dot(gravity, position.xyz), max(0.0, -outside),
                    uint(outside < contact_distance));
}

NodeSums add(NodeSums a, NodeSums b) {
    return NodeSums(a.momentum_x + b.momentum_x, a.momentum_y + b.momentum_y, a.momentum_z + b.momentum_z,
                    a.kinetic_energy + b.kinetic_energy, a.elastic_energy + b.elastic_energy,
                    a.potential_energy + b.potential_energy, max(a.deepest, b.deepest), a.contacts + b.contacts);
}

void main() {
    uint group = group_index();
    if (group >= chunk_count) return;  // the whole group leaves, so none waits at the barrier
    Chunk chunk = chunks[group];
    uint lane = gl_LocalInvocationID.x;
    NodeSums sums = NodeSums(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0u);
    float contact_distance = texelFetch(contact_distances, int(chunk.object)).x;
    for (uint k = lane; k < chunk.count; k += 64u) sums = add(sums, measure_node(chunk.first + k, contact_distance));
    parts[lane] = sums;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) sums = add(sums, parts[l]);
    node_sums[group] = sums;
}
