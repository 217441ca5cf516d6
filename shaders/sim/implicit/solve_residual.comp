// The residual r after a step along the direction p, and z, what the nodes' own blocks and those of bodies make of it; r . z by chunk.
// The rigid part of r follows from that of A p.
// CPU twin: gelatin::cpu::IslandSolve::precondition. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "layouts/element_edge.glsl"
#include "sim/elasticity/node_terms.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/body_sums.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer blocks;      // NodeBlock with inertia and rows, two texels each
uniform samplerBuffer directions;  // p [m]
uniform samplerBuffer products;    // A p [N]
layout(std430) readonly buffer ProductSums { ResidualSums product_sums[]; };  // by chunk
layout(std430) buffer States { SolveState states[]; };
layout(std430) buffer BodyForces { BodyMotion body_forces[]; };  // W^T r by object, two by turns
layout(std430) buffer Steps { vec4 steps[]; };          // [m]
layout(std430) buffer Residuals { vec4 residuals[]; };  // r [N]
layout(std430) writeonly buffer Preconditioned { vec4 preconditioned[]; };  // z [m]
layout(std430) writeonly buffer Lacks { float lacks[]; };                   // by chunk [J]

// How far along p the objective falls. The same in all work groups of an island.
float length_of_step(uint i, StepIsland island) {
    float sum = 0.0;
    for (uint k = island.first_chunk + gl_LocalInvocationID.x; k < island.chunk_end; k += 64u)
        sum += product_sums[texelFetch(island_chunks, int(k)).x].force.w;
    float curvature = sum_by_lanes(vec4(sum, vec3(0.0)), vec3(0.0)).force.x;
    if (curvature > 0.0) return states[state_before(i)].lack / curvature;
    bool writes_state = group_index() == texelFetch(island_chunks, int(island.first_chunk)).x;
    if (writes_state && gl_LocalInvocationID.x == 0u) states[state_before(i)].is_stuck = 1u;
    return 0.0;
}

// W^T r of a body after the step. The same in all of its work groups.
BodyMotion body_force(uint object, float a) {
    vec4 force = vec4(0.0), moment = vec4(0.0);
    uint end = texelFetch(chunk_starts, int(object) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(object)).x + gl_LocalInvocationID.x; c < end; c += 64u) {
        force += product_sums[c].force;
        moment += product_sums[c].moment;
    }
    ResidualSums sum = sum_by_lanes(force, moment.xyz);
    BodyMotion before = body_forces[state_before(object)];
    return BodyMotion(before.displacement - a * vec4(sum.force.xyz, 0.0), before.rotation - a * sum.moment);
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    uint i = large_island_of(chunk.x);
    if (i == kNone || states[state_before(i)].is_done != 0u) return;
    float a = length_of_step(i, fetch_island(i));
    BodyMotion force = body_force(chunk.x, a), motion = times(fetch_inverse(chunk.x), force);
    bool is_first = c == texelFetch(chunk_starts, int(chunk.x)).x;
    float lack = 0.0;
    if (is_first && lane == 0u) {
        body_forces[state_after(chunk.x)] = force;
        lack = dot_of(force, motion);
    }
    vec3 center = center_of(chunk.x);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        if (!(texelFetch(loads, int(n)).w > 0.0)) continue;
        steps[n].xyz += a * texelFetch(directions, int(n)).xyz;
        vec3 r = residuals[n].xyz - a * texelFetch(products, int(n)).xyz;
        vec3 z = solve(NodeTerms(vec3(0.0), texelFetch(blocks, 2 * int(n)).xyz, texelFetch(blocks, 2 * int(n) + 1).xyz), r);
        residuals[n] = vec4(r, 0.0);
        preconditioned[n] = vec4(z + at_node(motion, center, n), 0.0);
        lack += dot(r, z);
    }
    float sum = sum_by_lanes(vec4(lack, vec3(0.0)), vec3(0.0)).force.x;
    if (lane == 0u) lacks[c] = sum;
}
