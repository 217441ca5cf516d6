// What a step of true rotations differs by from a linear one, to second order, for the rotation that inertia wants: displacements
// that come of it alone are taken out, and forces rotate with their bodies. Then loads are complete. Where what is free is wanted is
// also what its solve starts from; what is held goes on as it goes. A work group a chunk.
// CPU twin: gelatin::cpu::RigidLevel::follow_rotation, gelatin::cpu::ImplicitStep::linearise.
// Parity: tests/gpu/implicit/part_start_test.cpp.
#include "sim/implicit/clock.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/body_sums.glsl"
#include "sim/implicit/sum_of_motions.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer velocities;  // xyz [m/s]
layout(std430) readonly buffer ElasticForces { vec4 elastic_forces[]; };       // [N]
layout(std430) buffer Displacements { vec4 displacements[]; };                 // d, xyz [m]
layout(std430) buffer Loads { vec4 all_loads[]; };                             // m / h^2 (y - x) + f [N]; w: m / h^2 [N/m]

vec3 rotation_of(uint object) {
    ResidualSums sum = sum_of_motions(object);
    return times(fetch_inverse(object), BodyMotion(sum.force, sum.moment)).rotation.xyz;
}

void main() {
    uint c = group_index();
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    bool is_free = texelFetch(bodies, 5 * int(chunk.x)).w > 0.0;
    vec3 center = center_of(chunk.x), w = rotation_of(chunk.x);  // 0 of what is held
    for (uint n = chunk.y + gl_LocalInvocationID.x; n < chunk.y + chunk.z; n += 64u) {
        float inertia = all_loads[n].w;
        vec3 d = displacements[n].xyz, f = elastic_forces[n].xyz;
        d -= 0.5 * cross(w, cross(w, texelFetch(positions, int(n)).xyz - center));
        all_loads[n].xyz = f + cross(w, f) + inertia * d;
        if (inertia > 0.0 && !is_free) d = clock[0].step * texelFetch(velocities, int(n)).xyz;
        displacements[n].xyz = d;
    }
}
