// CPU twin: gelatin::cpu::Islands::find.
#include "layouts/step_state.glsl"

// How what nothing holds moves on as a whole, and what handles carry, if nothing else holds it; 0 of others [m/s]; w: mass [kg].
vec4 common_motion(StartSums sums, bool is_driven) {
    float mass = sums.momentum.w;
    vec3 velocity = vec3(0.0);
    if (!is_driven && mass > 0.0)
        velocity = sums.held_count > 0.0 ? sums.carried.xyz / sums.carried.w : sums.momentum.xyz / mass;
    return vec4(velocity, mass);
}
