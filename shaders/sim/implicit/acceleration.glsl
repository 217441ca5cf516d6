// What gravity and loads accelerate nodes by.
#include "sim/drive/load_force.glsl"

uniform vec3 gravity;  // [m/s^2]

vec3 acceleration(uint n, float inverse_mass) {
#ifdef LOADED
    return gravity + inverse_mass * load_force(n);
#else
    return gravity;
#endif
}
