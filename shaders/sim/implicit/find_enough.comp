// The energy by which a solve may miss the least of each body: a part of its own, and of its share of its island's. A work group a
// body.
// CPU twin: gelatin::cpu::ImplicitStep::linearise. Parity: tests/gpu/implicit/part_start_test.cpp, pair_rows_test.cpp.
const uint kLanes = 64u;
#include "layouts/contact_tuning.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/node_chunks.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer island_of_object;
uniform usamplerBuffer islands;        // StepIsland, three texels each
uniform usamplerBuffer island_bodies;
uniform usamplerBuffer island_chunks;  // of nodes
uniform samplerBuffer paces;           // BodyPace, five texels each
uniform uint body_count;
layout(std430) readonly buffer Energies { float energies[]; };  // by chunk [J]
layout(std430) writeonly buffer Enough { float enough[]; };     // by object [J]

float mass_of(uint body) { return texelFetch(paces, 5 * int(body) + 2).w; }

void main() {
    uint o = group_index(), lane = gl_LocalInvocationID.x;
    if (o >= body_count) return;
    vec4 sums = vec4(0.0);  // its energy, that of its island, the island's mass
    uint end = texelFetch(chunk_starts, int(o) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(o)).x + lane; c < end; c += kLanes) sums.x += energies[c];
    uvec4 island = texelFetch(islands, 3 * int(texelFetch(island_of_object, int(o)).x));  // bodies, chunks
    for (uint k = island.z + lane; k < island.w; k += kLanes) sums.y += energies[texelFetch(island_chunks, int(k)).x];
    for (uint k = island.x + lane; k < island.y; k += kLanes) sums.z += mass_of(texelFetch(island_bodies, int(k)).x);
    sums = sum_over_group(sums);
    if (lane == 0u) enough[o] = kTolerance * (sums.x + kNearly * mass_of(o) / sums.z * sums.y);
}
