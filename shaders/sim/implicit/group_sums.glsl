// Sums and maxima over a work group of kLanes, in a fixed order; all of its invocations get the same bits. Between two calls no barrier
// is needed: what one reads after its last barrier the next writes after its first.
shared vec4 lane_parts[kLanes], row_parts[kLanes / 16u];

vec4 sum_over_group(vec4 own) {
    uint lane = gl_LocalInvocationID.x;
    lane_parts[lane] = own;
    barrier();
    if (lane < kLanes / 16u) {
        vec4 sum = vec4(0.0);
        for (uint k = 0u; k < 16u; ++k) sum += lane_parts[16u * lane + k];
        row_parts[lane] = sum;
    }
    barrier();
    vec4 sum = vec4(0.0);
    for (uint k = 0u; k < kLanes / 16u; ++k) sum += row_parts[k];
    return sum;
}

float sum_over_group(float own) { return sum_over_group(vec4(own, 0.0, 0.0, 0.0)).x; }

float max_over_group(float own) {
    uint lane = gl_LocalInvocationID.x;
    lane_parts[lane].x = own;
    barrier();
    if (lane < kLanes / 16u) {
        float most = own;
        for (uint k = 0u; k < 16u; ++k) most = max(most, lane_parts[16u * lane + k].x);
        row_parts[lane].x = most;
    }
    barrier();
    float most = row_parts[0].x;
    for (uint k = 1u; k < kLanes / 16u; ++k) most = max(most, row_parts[k].x);
    return most;
}
