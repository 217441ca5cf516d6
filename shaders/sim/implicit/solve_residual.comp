// The residual r after a step along the direction p, and what the nodes' own blocks make of it, z; with the sums over chunks that
// the rigid level needs. With BEGIN: the residual where the solve begins.
// CPU twin: gelatin::cpu::IslandSolve::precondition. Parity: tests/gpu/implicit/step_system_test.cpp.
#ifdef BEGIN
#define PRODUCTS
#include "sim/implicit/half_edges.glsl"
#endif
#include "sim/elasticity/node_terms.glsl"
#include "sim/implicit/solve_system.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;  // xyz [m]
uniform samplerBuffer blocks;     // NodeBlock, two texels each
uniform samplerBuffer bodies;     // StepBody, three texels each
#ifndef BEGIN
uniform samplerBuffer directions;  // p [m]
uniform samplerBuffer products;    // A p [N]
layout(std430) readonly buffer Curvatures { float curvatures[]; };  // by chunk [J]
layout(std430) buffer States { SolveState states[]; };
#endif
layout(std430) buffer Steps { vec4 steps[]; };          // [m]
layout(std430) buffer Residuals { vec4 residuals[]; };  // r [N]
layout(std430) writeonly buffer Preconditioned { vec4 preconditioned[]; };  // z [m]
layout(std430) writeonly buffer Sums { ResidualSums sums[]; };
shared vec4 forces[64], moments[64];

#ifdef BEGIN
vec3 residual_at(uint n, float inertia) {
    vec3 d = texelFetch(displacements, int(n)).xyz;
    steps[n] = vec4(0.0);
    return texelFetch(loads, int(n)).xyz - stiffness_times(n, d) - inertia * d;
}
#else
float length_of_step = 0.0;

// How far along p the objective falls. The same in all work groups of an object.
void find_length_of_step(uint object, uint lane) {
    uint first = texelFetch(chunk_starts, int(object)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
    float sum = 0.0;
    for (uint k = first + lane; k < end; k += 64u) sum += curvatures[k];
    forces[lane].x = sum;
    for (uint half_ = 32u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (lane < half_) forces[lane].x += forces[lane + half_].x;
    }
    barrier();
    float curvature = forces[0].x;
    barrier();
    uint state = state_before(object);
    length_of_step = curvature > 0.0 ? states[state].lack / curvature : 0.0;
    if (!(curvature > 0.0) && group_index() == first && lane == 0u) states[state].is_stuck = 1u;
}

vec3 residual_at(uint n, float inertia) {
    steps[n].xyz += length_of_step * texelFetch(directions, int(n)).xyz;
    return residuals[n].xyz - length_of_step * texelFetch(products, int(n)).xyz;
}
#endif

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
#ifndef BEGIN
    if (states[state_before(chunk.x)].is_done != 0u) return;
    find_length_of_step(chunk.x, lane);
#endif
    vec3 center = texelFetch(bodies, 3 * int(chunk.x)).xyz;
    vec4 force = vec4(0.0);
    vec3 moment = vec3(0.0);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        float inertia = texelFetch(loads, int(n)).w;
        vec3 r = vec3(0.0), z = vec3(0.0);
        if (inertia > 0.0) {
            r = residual_at(n, inertia);
            z = solve(NodeTerms(vec3(0.0), texelFetch(blocks, 2 * int(n)).xyz + inertia,
                                texelFetch(blocks, 2 * int(n) + 1).xyz), r);
        }
#ifdef BEGIN
        else steps[n] = vec4(0.0);
#endif
        residuals[n] = vec4(r, 0.0);
        preconditioned[n] = vec4(z, 0.0);
        force += vec4(r, dot(r, z));
        moment += cross(texelFetch(positions, int(n)).xyz - center, r);
    }
    forces[lane] = force;
    moments[lane] = vec4(moment, 0.0);
    for (uint half_ = 32u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (lane < half_) {
            forces[lane] += forces[lane + half_];
            moments[lane] += moments[lane + half_];
        }
    }
    if (lane == 0u) sums[c] = ResidualSums(forces[0], moments[0]);
}
