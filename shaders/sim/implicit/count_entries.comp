// How many rows each node has, of pairs and of planes, and the nodes of a chunk together. A work group a chunk.
// Host: gpu::RowTables. Parity: tests/gpu/implicit/pair_rows_test.cpp.
const uint kLanes = 64u;
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/near_pairs.glsl"
#include "sim/implicit/node_chunks.glsl"
layout(local_size_x = 64) in;

uniform uint collider_count;
uniform uint body_nodes;  // of all bodies
layout(std430) readonly buffer PlaneNotes { PlaneMemory plane_notes[]; };  // reach: 0 where there is no contact
layout(std430) buffer EntryCounts { uint entry_counts[]; };
layout(std430) writeonly buffer EntriesOfChunks { uint chunk_entries[]; };

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x, sum = 0u, all;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += kLanes) {
        uint count = entry_counts[n];
        for (uint k = 0u; k < collider_count && n < body_nodes; ++k)
            count += plane_notes[k * body_nodes + n].reach > 0.0 ? 1u : 0u;
        entry_counts[n] = count;
        sum += count;
    }
    count_before(sum, all);
    if (lane == 0u) chunk_entries[c] = all;
}
