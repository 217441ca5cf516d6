// How nodes go on from the part before: Newmark's method with weighted inertia, or implicit Euler's.
// CPU twin: gelatin::cpu::TimeScheme.
#include "layouts/contact_tuning.glsl"

struct Scheme {
    float size;                // h [s]
    float past;                // what a_0 counts by
    float alpha, beta, gamma;
};

Scheme scheme_of(float size, float past) {
    if (!(past > 0.0)) return Scheme(size, 0.0, 0.0, 1.0, 1.0);
    float alpha = (1.0 - kLeftOfFast) / (1.0 + kLeftOfFast);
    return Scheme(size, past, alpha, 0.25 * (1.0 + alpha) * (1.0 + alpha), 0.5 + alpha);
}

// h' [s]: the step whose inertia m / h'^2 the scheme has.
float inner_size(Scheme s) { return s.past > 0.0 ? 0.5 * s.size * sqrt(1.0 + s.alpha) : s.size; }

// y - x [m]: where inertia and what acts on a node take it. @param before a_0 [m/s^2]
vec3 target_by(Scheme s, vec3 velocity, vec3 acceleration, vec3 before) {
    float inner = inner_size(s);
    return s.size * velocity + inner * inner * acceleration + s.past * 0.25 * (1.0 - s.alpha) * s.size * s.size * before;
}

// At the end, of a node that was displaced by d [m/s]. @param acceleration a_0 [m/s^2]
vec3 velocity_by(Scheme s, vec3 velocity, vec3 acceleration, vec3 d) {
    float h = s.size;
    if (!(s.past > 0.0)) return d / h;
    vec3 now = (d - h * velocity - (0.5 - s.beta) * h * h * acceleration) / (s.beta * h * h);
    return velocity + h * ((1.0 - s.gamma) * acceleration + s.gamma * now);
}

// What something changes by in a second at the end. @param before where the part began @param change in the part
vec3 rate_by(Scheme s, vec3 before, vec3 change) {
    return (change / s.size - s.past * (1.0 - s.gamma) * before) / s.gamma;
}
