// The energy by which a solve may miss the least of each body, which is an island by itself. A work group a body.
// CPU twin: gelatin::cpu::ImplicitStep::linearise. Parity: tests/gpu/implicit/part_start_test.cpp.
const uint kLanes = 64u;
#include "layouts/contact_tuning.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/node_chunks.glsl"
layout(local_size_x = 64) in;

uniform uint body_count;
layout(std430) readonly buffer Energies { float energies[]; };  // by chunk [J]
layout(std430) writeonly buffer Enough { float enough[]; };     // by object [J]

void main() {
    uint o = group_index(), lane = gl_LocalInvocationID.x;
    if (o >= body_count || !goes_on()) return;
    float energy = 0.0;
    uint end = texelFetch(chunk_starts, int(o) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(o)).x + lane; c < end; c += kLanes) energy += energies[c];
    energy = sum_over_group(energy);
    if (lane == 0u) enough[o] = kTolerance * (1.0 + kInIsland) * energy;
}
