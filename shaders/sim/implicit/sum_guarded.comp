// What a guard has done to nodes that it has moved from where a part ends, by chunk; a work group each.
// CPU twin: gelatin::cpu::ImplicitStep::stop_guarded. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kSums = 8u;  // kGuardSums
#include "sim/implicit/clock.glsl"
#include "sim/implicit/lane_sums.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/guard_sums.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer displacements;  // d, xyz [m]
uniform samplerBuffer end_positions;  // [m]; w: inverse mass

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    double sums[kGuardSums];
    for (uint k = 0u; k < kGuardSums; ++k) sums[k] = 0.0LF;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 end = texelFetch(end_positions, int(n));
        vec3 wanted = texelFetch(positions, int(n)).xyz + texelFetch(displacements, int(n)).xyz;
        if (end.w > 0.0 && end.xyz != wanted) add_held_back(wanted, end, center_of(chunk.x), sums);
    }
    put_guard_sums(c, sums);
}
