// The rigid part of a body's velocities where a part ends, with the arms where it began [m/s], [rad/s]; 0 unless it is free. A work
// group an object.
// CPU twin: gelatin::cpu::RigidLevel::velocity. Parity: tests/gpu/implicit/part_end_test.cpp.
#include "layouts/end_sums.glsl"
#include "layouts/step_state.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/inverse_inertia.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer Paces { BodyPace paces[]; };
layout(std430) readonly buffer EnergySums { double energy_sums[]; };  // by chunk
layout(std430) writeonly buffer RigidVelocities { BodyMotion rigid_velocities[]; };

shared double body_sums[6];  // momentum, angular momentum

void main() {
    uint o = group_index(), lane = gl_LocalInvocationID.x;
    if (o >= object_count) return;
    if (lane < 6u) {
        uint k = lane < 3u ? kMomentum + lane : kTurning + lane - 3u, end = texelFetch(chunk_starts, int(o) + 1).x;
        double sum = 0.0LF;
        for (uint c = texelFetch(chunk_starts, int(o)).x; c < end; ++c) sum += energy_sums[c * kEnergySums + k];
        body_sums[lane] = sum;
    }
    barrier();
    if (lane > 0u) return;
    BodyMotion motion = BodyMotion(vec4(0.0), vec4(0.0));
    if (texelFetch(bodies, 5 * int(o)).w > 0.0) {
        vec3 momentum = vec3(body_sums[0], body_sums[1], body_sums[2]), angular = vec3(body_sums[3], body_sums[4], body_sums[5]);
        float mass = paces[o].velocity.w, weight = texelFetch(bodies, 5 * int(o) + 3).w / mass;
        motion = BodyMotion(vec4(momentum / mass, 0.0), vec4(weight * (inverse_inertia_of(o) * angular), 0.0));
    }
    rigid_velocities[o] = motion;
}
