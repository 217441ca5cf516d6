// How much of its step at all nodes an island makes, and the slips of its rows there; a work group an island.
// CPU twin: gelatin::cpu::IslandSolve::newton_step. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "sim/implicit/island_lanes.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/large_islands.glsl"
#include "sim/implicit/line_search.glsl"
layout(local_size_x = LANES) in;

uniform samplerBuffer displacements;  // d before the step, xyz [m]
uniform samplerBuffer steps;          // [m]
layout(std430) readonly buffer States { SolveState states[]; };
layout(std430) readonly buffer StepSums { vec2 step_sums[]; };  // by chunk of nodes [J]
layout(std430) writeonly buffer Parts { float parts[]; };       // by island

vec3 change_of(uint r) { return relative(rows[r], steps); }

void main() {
    uint i = group_index(), lane = gl_LocalInvocationID.x;
    if (i >= object_count) return;
    StepIsland island = fetch_island(i);
    if (is_small(island)) return;
    SolveState state = states[state_before(i)];
    if (!has_rows(island) || state.made == 0u) {
        if (lane != 0u) return;
        parts[i] = has_rows(island) ? 0.0 : 1.0;
        if (!has_rows(island) && state.is_done == 0u) open_round();
        return;
    }
    vec2 sum = vec2(0.0);
    for (uint k = island.first_chunk + lane; k < island.chunk_end; k += kLanes)
        sum += step_sums[texelFetch(island_chunks, int(k)).x];
    sum = sum_over_group(vec4(sum, 0.0, 0.0)).xy;
    float part = line_search(island, sum.x, sum.y);
    // Those of a body with itself have not followed its rigid motion so far.
    for (uint r = island.first_row + lane; r < island.row_end; r += kLanes)
        slips[r].xyz = relative(rows[r], displacements) + part * change_of(r);
    if (lane != 0u) return;
    parts[i] = part;
    open_round();
}
