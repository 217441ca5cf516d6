// The start of a step and where it leads without springs.
#include "include/load_force.glsl"
#include "include/pull.glsl"
layout(binding = 1) uniform samplerBuffer start_positions;   // xyz [m], inverse mass [1/kg]
layout(binding = 2) uniform samplerBuffer start_velocities;  // xyz [m/s], damping time [s]
uniform float time_step;                                     // h [s]
uniform vec3 gravity;                                        // [m/s^2]

vec3 target_of(uint node) {
    vec3 velocity = texelFetch(start_velocities, int(node)).xyz;
    vec4 start = texelFetch(start_positions, int(node));
    vec3 acceleration = gravity;
#ifdef LOADED
    acceleration += start.w * load_force(node);
#endif
    return start.xyz + time_step * (velocity + time_step * acceleration);
}
