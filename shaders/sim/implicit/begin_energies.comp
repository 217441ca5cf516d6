// The elastic energy of bodies where a step begins, whatever has set nodes; one invocation an object.
// CPU twin: gelatin::cpu::EnergyAccount::begin. Parity: tests/gpu/implicit/part_end_test.cpp.
#include "include/global_index.glsl"
#include "layouts/end_sums.glsl"
#include "layouts/step_end.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform uint object_count;
layout(std430) readonly buffer EnergySums { double energy_sums[]; };  // by chunk
layout(std430) buffer BodyEnergies { BodyEnergy energies[]; };

void main() {
    uint o = global_index();
    if (o >= object_count) return;
    double elastic = 0.0LF;
    uint end = texelFetch(chunk_starts, int(o) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(o)).x; c < end; ++c) elastic += energy_sums[c * kEnergySums + kElastic];
    energies[o].elastic = elastic;
}
