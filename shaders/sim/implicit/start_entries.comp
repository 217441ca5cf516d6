// Where the rows of each node begin in the tables; so also where the next of them goes. A work group a chunk, which adds up those
// before it.
// Host: gpu::RowTables. Parity: tests/gpu/implicit/pair_rows_test.cpp.
const uint kLanes = 64u;
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/near_pairs.glsl"
#include "sim/implicit/node_chunks.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer chunk_entries;
layout(std430) buffer EntryCounts { uint entry_counts[]; };
layout(std430) writeonly buffer EntryStarts { uint entry_starts[]; };  // of each node, and the end

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x, sum = 0u, next;
    if (c >= chunk_count) return;
    for (uint k = lane; k < c; k += kLanes) sum += texelFetch(chunk_entries, int(k)).x;
    count_before(sum, next);
    uvec4 chunk = texelFetch(chunks, int(c));
    for (uint base = 0u; base < chunk.z; base += kLanes) {
        uint n = chunk.y + base + lane, all;
        bool is_node = base + lane < chunk.z;
        uint at = next + count_before(is_node ? entry_counts[n] : 0u, all);
        next += all;
        if (!is_node) continue;
        entry_starts[n] = at;
        entry_counts[n] = at;
    }
    if (c + 1u == chunk_count && lane == 0u) entry_starts[chunk.y + chunk.z] = next;
}
