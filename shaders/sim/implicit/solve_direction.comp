// The next direction, z + b p, with the rigid level in z; a body that lacks no more of its least energy than it may is
// done. With FINISH: what was found becomes the displacement, and the rigid level's last answer with it.
// CPU twin: gelatin::cpu::IslandSolve::conjugate_gradients. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "sim/implicit/solve_system.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;       // xyz [m]
uniform samplerBuffer bodies;          // StepBody, three texels each
layout(std430) readonly buffer Sums { ResidualSums sums[]; };

// A rigid motion of a body for a force and moment, about its centre.
struct Motion {
    vec3 displacement, rotation;
    float lack;  // r . z of the body [J]
};

Motion motion_of(uint object) {
    vec4 force = vec4(0.0);
    vec3 moment = vec3(0.0);
    uint end = texelFetch(chunk_starts, int(object) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(object)).x; c < end; ++c) {
        force += sums[c].force;
        moment += sums[c].moment.xyz;
    }
    float inverse_inertia = texelFetch(bodies, 3 * int(object)).w;
    vec3 d = texelFetch(bodies, 3 * int(object) + 1).xyz, b = texelFetch(bodies, 3 * int(object) + 2).xyz;
    vec3 displacement = inverse_inertia * force.xyz;
    vec3 rotation = d * moment + b.zxy * moment.yzx + b.yzx * moment.zxy;
    return Motion(displacement, rotation, force.w + dot(displacement, force.xyz) + dot(rotation, moment));
}

vec3 at_node(Motion motion, vec3 center, uint n) {
    return motion.displacement + cross(motion.rotation, texelFetch(positions, int(n)).xyz - center);
}

#ifdef FINISH
uniform samplerBuffer steps;  // [m]
layout(std430) buffer Displacements { vec4 displacements[]; };  // d [m]

void main() {
    uint c = group_index();
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    Motion motion = motion_of(chunk.x);
    vec3 center = texelFetch(bodies, 3 * int(chunk.x)).xyz;
    for (uint n = chunk.y + gl_LocalInvocationID.x; n < chunk.y + chunk.z; n += 64u)
        if (texelFetch(loads, int(n)).w > 0.0)
            displacements[n].xyz += texelFetch(steps, int(n)).xyz + at_node(motion, center, n);
}
#else
uniform samplerBuffer preconditioned;  // z [m]
layout(std430) buffer Directions { vec4 directions[]; };  // p [m]
layout(std430) buffer States { SolveState states[]; };
uniform uint is_first;  // there is no direction yet

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    bool writes_state = lane == 0u && c == texelFetch(chunk_starts, int(chunk.x)).x;
    SolveState state = SolveState(0.0, 0u, 0u, 0u);
    if (is_first == 0u) state = states[state_before(chunk.x)];
    if (state.is_done != 0u) {
        if (writes_state) states[state_after(chunk.x)] = state;
        return;
    }
    Motion motion = motion_of(chunk.x);
    float lack = motion.lack, enough = texelFetch(bodies, 3 * int(chunk.x) + 1).w;
    // One iteration is made in any case: what elements exert counts, however short the part.
    bool is_done = !(lack > 0.0) || (is_first == 0u && lack <= enough) || state.is_stuck != 0u;
    if (writes_state)
        states[state_after(chunk.x)] =
            SolveState(lack, is_done ? 1u : 0u, 0u, state.iterations + (is_first == 0u ? 1u : 0u));
    float b = is_first == 0u ? lack / state.lack : 0.0;
    vec3 center = texelFetch(bodies, 3 * int(chunk.x)).xyz;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec3 p = vec3(0.0);
        if (texelFetch(loads, int(n)).w > 0.0) {
            p = texelFetch(preconditioned, int(n)).xyz + at_node(motion, center, n);
            if (is_first == 0u) p += b * directions[n].xyz;
        }
        directions[n] = vec4(p, 0.0);
    }
}
#endif
