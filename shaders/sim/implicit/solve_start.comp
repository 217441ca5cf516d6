// Where conjugate gradients begin: what is left on each body, its rigid motion by its own block, and the state of its island. A work
// group an island.
// CPU twin: gelatin::cpu::IslandSolve::conjugate_gradients. Parity: tests/gpu/implicit/step_system_test.cpp.
const uint kLanes = 64u;
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/solve_state.glsl"
#include "sim/implicit/large_islands.glsl"
#include "sim/implicit/group_sums.glsl"
layout(local_size_x = 64) in;

uniform uint is_first;  // of the linearisations
layout(std430) readonly buffer Sums { ResidualSums sums[]; };         // of the residual, by chunk
layout(std430) writeonly buffer BodyForces { BodyMotion body_forces[]; };  // W^T r by object, two by turns
layout(std430) writeonly buffer BodyMotions { BodyMotion body_motions[]; };
layout(std430) buffer States { SolveState states[]; };

void main() {
    uint i = group_index(), lane = gl_LocalInvocationID.x;
    if (i >= object_count) return;
    StepIsland island = fetch_island(i);
    if (is_small(island)) return;
    if (is_first == 0u && !has_rows(island)) {  // goes on with the first one
        if (lane == 0u && states[state_before(i)].is_done == 0u) open_iteration();
        return;
    }
    vec2 total = vec2(0.0);
    for (uint k = island.first_body + lane; k < island.body_end; k += kLanes) {
        uint object = texelFetch(island_bodies, int(k)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
        vec4 force = vec4(0.0), moment = vec4(0.0);
        for (uint c = texelFetch(chunk_starts, int(object)).x; c < end; ++c) {
            force += sums[c].force;
            moment += sums[c].moment;
        }
        BodyMotion left = BodyMotion(vec4(force.xyz, 0.0), moment), motion = times(fetch_inverse(object), left);
        body_forces[state_before(object)] = left;
        body_motions[object] = motion;
        total += lack_of(object, force.w + dot_of(left, motion));
    }
    total = sum_over_group(vec4(total, 0.0, 0.0)).xy;
    if (lane != 0u) return;
    SolveState state = SolveState(0.0, 0u, 0u, 0u, 0u, 0.0, 0u, 0u);
    if (is_first == 0u) state = states[state_before(i)];
    if (is_first == 0u && state.made == 0u) state.is_over = 1u;
    state = first_state(state, total, has_rows(island));
    states[state_before(i)] = state;
    if (state.is_done == 0u) open_iteration();
}
