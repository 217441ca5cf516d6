// What a solve has found, as a rigid motion of each body: sums over a chunk, a work group each.
// CPU twin: gelatin::cpu::RigidLevel::rotate. Parity: tests/gpu/implicit/part_end_test.cpp.
#include "layouts/step_state.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/body_sums.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer displacements;  // d, xyz [m]
layout(std430) readonly buffer Clock { StepClock clock[]; };
layout(std430) writeonly buffer BaseSums { ResidualSums base_sums[]; };

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count || clock[0].goes_on == 0u || clock[0].is_over != 0u) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    vec3 center = center_of(chunk.x), force = vec3(0.0), moment = vec3(0.0);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec3 d = texelFetch(loads, int(n)).w * texelFetch(displacements, int(n)).xyz;
        force += d;
        moment += cross(texelFetch(positions, int(n)).xyz - center, d);
    }
    ResidualSums sum = sum_by_lanes(vec4(force, 0.0), moment);
    if (lane == 0u) base_sums[c] = sum;
}
