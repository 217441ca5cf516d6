// Sums of forces and moments over a work group of kLanes, for kernels that have its other sums, too.
#include "sim/implicit/group_sums.glsl"

shared vec4 lane_moments[kLanes], row_moments[kLanes / 16u];

ResidualSums sum_by_lanes(vec4 force, vec3 moment) {
    uint lane = gl_LocalInvocationID.x;
    lane_parts[lane] = force;
    lane_moments[lane] = vec4(moment, 0.0);
    barrier();
    if (lane < kLanes / 16u) {
        ResidualSums sum = ResidualSums(vec4(0.0), vec4(0.0));
        for (uint k = 0u; k < 16u; ++k) {
            sum.force += lane_parts[16u * lane + k];
            sum.moment += lane_moments[16u * lane + k];
        }
        row_parts[lane] = sum.force;
        row_moments[lane] = sum.moment;
    }
    barrier();
    ResidualSums sum = ResidualSums(vec4(0.0), vec4(0.0));
    for (uint k = 0u; k < kLanes / 16u; ++k) {
        sum.force += row_parts[k];
        sum.moment += row_moments[k];
    }
    return sum;
}
