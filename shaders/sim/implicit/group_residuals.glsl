// Sums of forces and moments over a work group of kLanes, for kernels that have its other sums, too.
#include "sim/implicit/group_sums.glsl"

ResidualSums sum_by_lanes(vec4 force, vec3 moment) {
    vec4 sum = sum_over_group(force);
    return ResidualSums(sum, sum_over_group(vec4(moment, 0.0)));
}
