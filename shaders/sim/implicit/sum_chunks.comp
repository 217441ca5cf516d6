// Sums over the chunks of each body of an island, and what the island has gained. A work group for each body: that of an island's first
// has all of them.
// CPU twin: gelatin::cpu::EnergyAccount::measure. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kSums = 12u;  // kGainSums
#define SUMS_ARE_OWN
#include "sim/implicit/lane_sums.glsl"
#include "sim/implicit/object_sums.glsl"
#include "sim/implicit/energy_gain.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/island_bodies.glsl"
layout(local_size_x = 64) in;

uniform uint body_count;
layout(std430) readonly buffer Paces { BodyPace paces[]; };
layout(std430) readonly buffer BodyEnergies { BodyEnergy energies[]; };
layout(std430) readonly buffer EnergySums { double energy_sums[]; };      // by chunk
layout(std430) readonly buffer PartSums { double part_sums[]; };          // by chunk
layout(std430) writeonly buffer IslandSums { double island_sums[]; };     // of its island, by body

shared double totals[kGainSums], island_sum[kIslandSums];

void sum_chunks(IslandBodies island) {
    const uint kOfChunks = kEnergySums + kPartSums;
    for (uint e = gl_LocalInvocationID.x; e < (island.end - island.first) * kOfChunks; e += 64u) {
        uint o = body_at(island, island.first + e / kOfChunks), k = e % kOfChunks;
        double sum = 0.0LF;
        uint end = texelFetch(chunk_starts, int(o) + 1).x;
        for (uint c = texelFetch(chunk_starts, int(o)).x; c < end; ++c) {
            double own = k < kEnergySums ? energy_sums[c * kEnergySums + k] : part_sums[c * kPartSums + k - kEnergySums];
            sum = k == kEnergySums + kGreatestSpeed ? max(sum, own) : sum + own;
        }
        object_sums[o * kObjectSums + k] = sum;
    }
    memoryBarrierBuffer();
    barrier();
}

void main() {
    uint number = group_index(), lane = gl_LocalInvocationID.x;
    if (number >= body_count) return;
    IslandBodies island = bodies_beside(number);
    if (first_body(island) != number) return;
    sum_chunks(island);
    double sums[kGainSums];
    for (uint k = 0u; k < kGainSums; ++k) sums[k] = 0.0LF;
    for (uint k = island.first + lane; k < island.end; k += 64u) {
        uint o = body_at(island, k);
        object_sums[o * kObjectSums + kVibrations] = vibrations_of(o, texelFetch(bodies, 5 * int(o)).w > 0.0);
        add_gain(o, paces[o], energies[o], sums);
    }
    for (uint k = 0u; k < kGainSums; ++k) put_sum(k, sums[k]);
    barrier();
    if (lane < kGainSums) totals[lane] = sum_of_lanes(lane);
    barrier();
    if (lane == 0u) {
        for (uint k = 0u; k < kGainSums; ++k) sums[k] = totals[k];
        island_sum = gain_of(sums, paces[number].is_held != 0u);
    }
    barrier();
    for (uint k = island.first + lane; k < island.end; k += 64u)
        for (uint s = 0u; s < kIslandSums; ++s) island_sums[body_at(island, k) * kIslandSums + s] = island_sum[s];
}
