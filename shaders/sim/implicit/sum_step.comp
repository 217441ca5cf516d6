// A times the step of a linearisation, without rows: what the residual lost, less what rows did. By chunk: what pulls along the step,
// and by how much less it does so at its end.
// CPU twin: gelatin::cpu::IslandSolve::newton_step. Parity: tests/gpu/implicit/step_system_test.cpp.
#define ROWS
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/body_sums.glsl"
#include "sim/implicit/rows_at_nodes.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer slips;      // s [m]
uniform samplerBuffer steps;      // [m]
uniform samplerBuffer bases;      // without rows [N]
uniform samplerBuffer residuals;  // r after the step [N]
layout(std430) readonly buffer States { SolveState states[]; };
layout(std430) writeonly buffer Products { vec4 products[]; };     // [N]
layout(std430) writeonly buffer StepSums { vec2 step_sums[]; };  // [J]

vec3 row_value(uint r, StepRow row) {
    vec3 s = texelFetch(slips, int(r)).xyz + relative(row, steps);
    return texelFetch(tangents, 3 * int(r)).xyz - times(row_stiffness(r), s);
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    uint island = large_island_of(chunk.x);
    if (island == kNone || !has_rows(fetch_island(island)) || states[state_before(island)].made == 0u) return;
    vec2 own = vec2(0.0);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec3 step = texelFetch(steps, int(n)).xyz, base = texelFetch(bases, int(n)).xyz, resists = vec3(0.0);
        if (texelFetch(loads, int(n)).w > 0.0) resists = base + sum_of_rows(n) - texelFetch(residuals, int(n)).xyz;
        products[n] = vec4(resists, 0.0);
        own += vec2(dot(step, base), dot(step, resists));
    }
    ResidualSums sum = sum_by_lanes(vec4(own, 0.0, 0.0), vec3(0.0));
    if (lane == 0u) step_sums[c] = sum.force.xy;
}
