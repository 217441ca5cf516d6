// The rows of each node ascend, in whatever order they were written: so sums over them have a fixed order. An invocation a node.
// Host: gpu::RowTables. Parity: tests/gpu/implicit/pair_rows_test.cpp.
#include "include/global_index.glsl"
#include "sim/implicit/near_pairs.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer entry_starts;  // of each node, and the end
uniform uint node_count;
layout(std430) buffer RowEntries { uint row_entries[]; };

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    uint first = texelFetch(entry_starts, int(n)).x, end = texelFetch(entry_starts, int(n) + 1).x;
    for (uint e = first + 1u; e < end; ++e) {
        uint entry = row_entries[e], at = e;
        for (; at > first && row_entries[at - 1u] > entry; --at) row_entries[at] = row_entries[at - 1u];
        row_entries[at] = entry;
    }
}
