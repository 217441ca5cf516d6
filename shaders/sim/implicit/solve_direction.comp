// The next direction, z + b p; an island of which no body lacks more of its least energy than it may is done. FIRST: there is no
// direction yet, and the rigid level is not yet in z.
// CPU twin: gelatin::cpu::IslandSolve::conjugate_gradients. Parity: tests/gpu/implicit/step_system_test.cpp.
const uint kLanes = 64u;
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/solve_state.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer preconditioned;  // z [m]
layout(std430) buffer Directions { vec4 directions[]; };  // p [m]
layout(std430) buffer States { SolveState states[]; };
#ifdef FIRST
uniform samplerBuffer body_motions;  // BodyMotion by object, two texels each
uniform uint is_first;               // of the linearisations
#else
#include "sim/implicit/large_islands.glsl"
layout(std430) readonly buffer Lacks { float lacks[]; };  // r . z by chunk [J]

// What the island lacks after an iteration.
vec2 total_lack(StepIsland island) {
    vec2 total = vec2(0.0);
    for (uint k = island.first_body + gl_LocalInvocationID.x; k < island.body_end; k += kLanes) {
        uint object = texelFetch(island_bodies, int(k)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
        float of_body = 0.0;
        for (uint c = texelFetch(chunk_starts, int(object)).x; c < end; ++c) of_body += lacks[c];
        total += lack_of(object, of_body);
    }
    return sum_over_group(vec4(total, 0.0, 0.0)).xy;
}
#endif

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    uint i = large_island_of(chunk.x);
    if (i == kNone) {  // what was solved before is forgotten
#ifdef FIRST
        for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) directions[n] = vec4(0.0);
#endif
        return;
    }
    StepIsland island = fetch_island(i);
    SolveState state = states[state_before(i)];
#ifdef FIRST
    if (state.is_done != 0u || (is_first == 0u && !has_rows(island))) return;
    BodyMotion motion = BodyMotion(texelFetch(body_motions, 2 * int(chunk.x)), texelFetch(body_motions, 2 * int(chunk.x) + 1));
    vec3 center = center_of(chunk.x);
#else
    bool writes_state = lane == 0u && c == texelFetch(island_chunks, int(island.first_chunk)).x;
    bool was_done = state.is_done != 0u;
    float before = state.lack;
    if (!was_done) state = next_state(state, total_lack(island), has_rows(island));
    if (writes_state) states[state_after(i)] = state;
    if (was_done) return;
    if (writes_state) open_iteration();  // or else that would not have the state
    float b = state.lack / before;
#endif
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec3 p = vec3(0.0);
        if (texelFetch(loads, int(n)).w > 0.0) {
            p = texelFetch(preconditioned, int(n)).xyz;
#ifdef FIRST
            p += at_node(motion, center, n);
#else
            p += b * directions[n].xyz;
#endif
        }
        directions[n] = vec4(p, 0.0);
    }
}
