// What the displacements of nodes are to their body as a rigid one, weighted by inertia, by chunk. A work group a chunk.
// CPU twin: gelatin::cpu::RigidLevel::rigid_part. Parity: tests/gpu/implicit/part_start_test.cpp, part_end_test.cpp.
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/body_sums.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer displacements;  // d, xyz [m]
layout(std430) writeonly buffer BaseSums { ResidualSums base_sums[]; };

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    vec3 center = center_of(chunk.x), force = vec3(0.0), moment = vec3(0.0);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec3 own = texelFetch(loads, int(n)).w * texelFetch(displacements, int(n)).xyz;
        force += own;
        moment += cross(texelFetch(positions, int(n)).xyz - center, own);
    }
    ResidualSums sum = sum_by_lanes(vec4(force, 0.0), moment);
    if (lane == 0u) base_sums[c] = sum;
}
