// One node's part of a pass of an explicit scheme (src/model/explicit/explicit_scheme.h), given the force of its springs [N].
// A node without inverse mass moves with the velocity that it has.
// MULTI_PASS: the scheme has several passes, whose weighted rates add up in sum_*. CPU twin: src/cpu/explicit/integrate_node.h.
#include "sim/collision/colliders.glsl"
#include "sim/drive/load_force.glsl"
#include "sim/drive/pull.glsl"

uniform samplerBuffer base_positions;   // xyz [m], inverse mass [1/kg]: at the step's start
uniform samplerBuffer base_velocities;  // xyz [m/s], damping time [s]
uniform samplerBuffer positions;        // where forces are evaluated
uniform samplerBuffer velocities;

layout(std430) writeonly buffer OutPositions { vec4 out_positions[]; };
layout(std430) writeonly buffer OutVelocities { vec4 out_velocities[]; };
#ifdef MULTI_PASS
layout(std430) buffer SumPositions { vec4 sum_positions[]; };
layout(std430) buffer SumVelocities { vec4 sum_velocities[]; };
uniform float weight;     // of this pass in the sum
uniform float next_step;  // where the next pass evaluates: h next [s]
uniform uint is_first;
uniform uint is_last;
#endif
uniform uint node_count;
uniform float time_step;      // h [s]
uniform uint semi_implicit;   // positions move with the new velocity
uniform vec3 gravity;         // [m/s^2]
uniform float resting_speed;  // [m/s]

void integrate_node(uint n, vec4 velocity, vec3 force) {
    vec4 base_position = texelFetch(base_positions, int(n));
    vec4 base_velocity = texelFetch(base_velocities, int(n));
    if (base_position.w == 0.0) {
#ifdef MULTI_PASS
        float way_time = is_last != 0u ? time_step : next_step;
#else
        float way_time = time_step;
#endif
        out_positions[n] = vec4(base_position.xyz + way_time * base_velocity.xyz, 0.0);
        out_velocities[n] = base_velocity;
        return;
    }
#ifdef LOADED
    force += load_force(n);
#endif
#ifdef PULLED
    force += pull_force(n, texelFetch(positions, int(n)).xyz, velocity.xyz, base_position.w, time_step);
#endif
    vec3 rate = velocity.xyz;
    vec3 acceleration = gravity + base_position.w * force;
#ifdef MULTI_PASS
    vec3 here = rate;
    vec3 here_acceleration = acceleration;
    rate *= weight;
    acceleration *= weight;
    if (is_first == 0u) {
        rate += sum_positions[n].xyz;
        acceleration += sum_velocities[n].xyz;
    }
    if (is_last == 0u) {
        sum_positions[n] = vec4(rate, 0.0);
        sum_velocities[n] = vec4(acceleration, 0.0);
        out_positions[n] = vec4(base_position.xyz + next_step * here, base_position.w);
        out_velocities[n] = vec4(base_velocity.xyz + next_step * here_acceleration, base_velocity.w);
        return;
    }
#endif
    vec3 new_velocity = base_velocity.xyz + time_step * acceleration;
    vec3 new_position = base_position.xyz + time_step * (semi_implicit != 0u ? new_velocity : rate);
    resolve_colliders(resting_speed, new_position, new_velocity);
    out_positions[n] = vec4(new_position, base_position.w);
    out_velocities[n] = vec4(new_velocity, base_velocity.w);
}
