// Sums over a chunk of what the guard has done to nodes. To be included after sim/implicit/lane_sums.glsl and clock.glsl.
// CPU twin: gelatin::cpu::ImplicitStep::stop_guarded.
layout(std430) writeonly buffer GuardSums { double guard_sums[]; };  // by chunk

// Of a node that it has held back. @param wanted where it was to go [m] @param center of its body [m]
void add_held_back(vec3 wanted, vec4 end, vec3 center, inout double sums[kGuardSums]) {
    dvec3 change = dvec3((end.xyz - wanted) / clock[0].step) / double(end.w);
    dvec3 moment = cross(dvec3(end.xyz) - dvec3(center), change);
    sums[kHeldBack] += 1.0LF;
    if (end.xyz != wanted) sums[kStopped] += 1.0LF;
    for (int k = 0; k < 3; ++k) {
        sums[kChange + uint(k)] += change[k];
        sums[kChangeMoment + uint(k)] += moment[k];
    }
}

// In all invocations.
void put_guard_sums(uint c, double sums[kGuardSums]) {
    uint lane = gl_LocalInvocationID.x;
    for (uint k = 0u; k < kGuardSums; ++k) put_sum(k, sums[k]);
    barrier();
    if (lane < kGuardSums) guard_sums[c * kGuardSums + lane] = sum_of_lanes(lane);
}
