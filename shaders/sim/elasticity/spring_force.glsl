// Force on endpoint a of the spring a-b [N]: k (l - rest_length + t l') towards b, with the damping time t [s] (the mean of
// both nodes', stored in velocity.w) and l' the rate of change of the length. Damping along the spring after Nealen et al.
// 2006, eq. 5. Coincident endpoints give zero, not NaN. CPU twin: src/cpu/elasticity/spring_force.h.
vec3 spring_force(vec4 a, vec4 b, vec4 velocity_a, vec4 velocity_b, float rest_length, float stiffness) {
    vec3 d = b.xyz - a.xyz;
    float length_squared = max(dot(d, d), 1e-30);
    float inverse_length = inversesqrt(length_squared);
    float rate = dot(velocity_b.xyz - velocity_a.xyz, d) * inverse_length;
    float damping_time = 0.5 * (velocity_a.w + velocity_b.w);
    float stretch = length_squared * inverse_length - rest_length + damping_time * rate;
    return d * (stiffness * stretch * inverse_length);
}
