// Sums over a chunk by its work group of 64. What is summed is a field of forces on nodes, its moment, and a product.
shared vec4 forces[64], moments[64];

// In all invocations.
ResidualSums sum_by_lanes(vec4 force, vec3 moment) {
    uint lane = gl_LocalInvocationID.x;
    barrier();  // whoever still reads the sum before
    forces[lane] = force;
    moments[lane] = vec4(moment, 0.0);
    for (uint half_ = 32u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (lane < half_) {
            forces[lane] += forces[lane + half_];
            moments[lane] += moments[lane + half_];
        }
    }
    barrier();
    return ResidualSums(forces[0], moments[0]);
}
