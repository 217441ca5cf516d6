// Sums over bodies. SUMS_ARE_OWN: the kernel writes them.
#include "sim/implicit/rigid_part.glsl"

#ifdef SUMS_ARE_OWN
layout(std430) coherent buffer ObjectSums { double object_sums[]; };
#else
layout(std430) readonly buffer ObjectSums { double object_sums[]; };
#endif

double energy_sum(uint o, uint k) { return object_sums[o * kObjectSums + k]; }
double part_sum(uint o, uint k) { return object_sums[o * kObjectSums + kEnergySums + k]; }

dvec3 energy_sums_of(uint o, uint k) { return dvec3(energy_sum(o, k), energy_sum(o, k + 1u), energy_sum(o, k + 2u)); }
dvec3 part_sums_of(uint o, uint k) { return dvec3(part_sum(o, k), part_sum(o, k + 1u), part_sum(o, k + 2u)); }

void find_motion(uint o, out double motion[kMotionSums]) {
    for (uint k = 0u; k < kMotionSums; ++k) motion[k] = energy_sum(o, k);
}
