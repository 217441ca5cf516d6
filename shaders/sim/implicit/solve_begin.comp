// Where a linearisation begins: the step before is made, as far as the objective falls; the residual r with the tangents of rows, the
// nodes' own blocks, what these make of r, and the sums over chunks that the rigid level needs. FIRST: no step is before.
// CPU twin: gelatin::cpu::IslandSolve::newton_step. Parity: tests/gpu/implicit/step_system_test.cpp.
#ifdef FIRST
#define PRODUCTS
#endif
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/node_system.glsl"
#include "sim/implicit/body_sums.glsl"
layout(local_size_x = 64) in;

layout(std430) buffer Steps { vec4 steps[]; };                  // [m]
layout(std430) buffer Bases { vec4 bases[]; };                  // loads - A d, without rows [N]
layout(std430) writeonly buffer Residuals { vec4 residuals[]; };  // r [N]
layout(std430) writeonly buffer Preconditioned { vec4 preconditioned[]; };  // z [m]
layout(std430) writeonly buffer Blocks { NodeBlock blocks[]; };
layout(std430) writeonly buffer Sums { ResidualSums sums[]; };
#ifdef ROWS
uniform samplerBuffer slips;  // s [m]
vec3 row_value(uint r, StepRow row) {
    return texelFetch(tangents, 3 * int(r)).xyz - times(row_stiffness(r), texelFetch(slips, int(r)).xyz);
}
#endif

#ifdef FIRST
vec3 base_at(uint n, uint island, vec4 load) { return base_of(n, load, texelFetch(displacements, int(n)).xyz); }
#else
uniform samplerBuffer parts;          // of each island's step, that it makes
uniform samplerBuffer products;       // by how much less the base is after the step [N]
uniform usamplerBuffer states;        // SolveState, two texels each
layout(std430) buffer Displacements { vec4 displacements[]; };  // d [m]

vec3 base_at(uint n, uint island, vec4 load) {
    float part = texelFetch(parts, int(island)).x;
    displacements[n].xyz += part * steps[n].xyz;
    return bases[n].xyz - part * texelFetch(products, int(n)).xyz;
}
#endif

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    uint island = large_island_of(chunk.x);
    if (island == kNone) {  // what was solved before is forgotten
#ifdef FIRST
        for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) steps[n] = vec4(0.0);
#endif
        return;
    }
#ifndef FIRST
    if (!has_rows(fetch_island(island)) || texelFetch(states, 2 * int(state_before(island)) + 1).z != 0u)
        return;
#endif
    vec3 center = center_of(chunk.x), moment = vec3(0.0);
    vec4 force = vec4(0.0);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 load = texelFetch(loads, int(n));
        vec3 base = vec3(0.0), r = vec3(0.0), z = vec3(0.0);
        if (load.w > 0.0) {
            base = base_at(n, island, load);
            r = base + sum_of_rows(n);
            NodeTerms block = block_at(n, load.w);
            blocks[n] = NodeBlock(vec4(block.diagonal, 0.0), vec4(block.beside, 0.0));
            z = solve(block, r);
        }
        steps[n] = vec4(0.0);
        bases[n] = vec4(base, 0.0);
        residuals[n] = vec4(r, 0.0);
        preconditioned[n] = vec4(z, 0.0);
        force += vec4(r, dot(r, z));
        moment += cross(texelFetch(positions, int(n)).xyz - center, r);
    }
    ResidualSums sum = sum_by_lanes(force, moment);
    if (lane == 0u) sums[c] = sum;
}
