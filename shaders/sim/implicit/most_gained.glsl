// What islands have gained, for one work group of kLanes.
// CPU twin: gelatin::cpu::EnergyAccount::measure.
#include "layouts/end_sums.glsl"

uniform uint body_count;
layout(std430) readonly buffer IslandSums { double island_sums[]; };  // of its island, by body

shared float lane_gains[kLanes];

// Of all invocations.
float most_of_group(float own) {
    uint lane = gl_LocalInvocationID.x;
    lane_gains[lane] = own;
    for (uint half_ = kLanes / 2u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (lane < half_) lane_gains[lane] = max(lane_gains[lane], lane_gains[lane + half_]);
    }
    barrier();
    return lane_gains[0];
}

// Of all islands the most, as a part of the energy then; infinite where something is not finite.
float most_gained() {
    float gained = 0.0;
    for (uint o = gl_LocalInvocationID.x; o < body_count; o += kLanes)
        gained = max(gained, float(island_sums[o * kIslandSums + kIslandGain]));
    return most_of_group(gained);
}
