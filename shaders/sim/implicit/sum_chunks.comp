// Sums over the chunks of a body, whose work group this is.
// CPU twin: gelatin::cpu::EnergyAccount. Parity: tests/gpu/implicit/part_end_test.cpp.
#include "include/global_index.glsl"
#include "layouts/end_sums.glsl"
#include "sim/implicit/clock.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform uint object_count;
layout(std430) readonly buffer EnergySums { double energy_sums[]; };  // by chunk
layout(std430) readonly buffer PartSums { double part_sums[]; };      // by chunk
layout(std430) writeonly buffer ObjectSums { double object_sums[]; };

void main() {
    uint o = group_index(), k = gl_LocalInvocationID.x;
    if (o >= object_count || !goes_on() || k >= kObjectSums) return;
    double sum = 0.0LF;
    uint end = texelFetch(chunk_starts, int(o) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(o)).x; c < end; ++c) {
        double own = k < kEnergySums ? energy_sums[c * kEnergySums + k] : part_sums[c * kPartSums + k - kEnergySums];
        sum = k == kEnergySums + kGreatestSpeed ? max(sum, own) : sum + own;
    }
    object_sums[o * kObjectSums + k] = sum;
}
