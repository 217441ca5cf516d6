// Counts over a work group of kLanes. Between two calls no barrier is needed.
shared uint lane_counts[kLanes], row_counts[kLanes / 16u];

// Of the invocations before this one together. @param all of the group
uint count_before(uint own, out uint all) {
    uint lane = gl_LocalInvocationID.x;
    lane_counts[lane] = own;
    barrier();
    if (lane < kLanes / 16u) {
        uint sum = 0u;
        for (uint k = 16u * lane; k < 16u * lane + 16u; ++k) {
            sum += lane_counts[k];
            lane_counts[k] = sum;
        }
        row_counts[lane] = sum;
    }
    barrier();
    uint before = lane_counts[lane] - own;
    all = 0u;
    for (uint k = 0u; k < kLanes / 16u; ++k) {
        if (k < lane / 16u) before += row_counts[k];
        all += row_counts[k];
    }
    return before;
}
