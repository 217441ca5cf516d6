// If the part is made, what its contacts hold is what they held before. A row's first node always bears some of it. An
// invocation a node.
// CPU twin: gelatin::cpu::ContactRows::remember. Parity: tests/gpu/implicit/pair_rows_test.cpp.
#include "include/global_index.glsl"
#include "layouts/near_pair.glsl"
#include "layouts/step_end.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer entry_starts;  // of each node, and the end
uniform usamplerBuffer row_entries;
uniform uint node_count;
layout(std430) readonly buffer BodyChanges { BodyChange changes[]; };
layout(std430) readonly buffer RowNotes { RowMemory row_notes[]; };
layout(std430) writeonly buffer KnownStarts { uint known_starts[]; };
layout(std430) writeonly buffer KnownEntries { uint known_entries[]; };
layout(std430) writeonly buffer KnownRows { RowMemory known_rows[]; };

void main() {
    if (changes[0].action != 1u) return;
    uint n = global_index();
    if (n >= node_count) return;
    uint first = texelFetch(entry_starts, int(n)).x, end = texelFetch(entry_starts, int(n) + 1).x;
    known_starts[n] = first;
    known_starts[n + 1u] = end;  // whoever writes it writes the same
    for (uint e = first; e < end; ++e) {
        uint entry = texelFetch(row_entries, int(e)).x;
        known_entries[e] = entry;
        if (entry % 4u == 0u) known_rows[entry / 4u] = row_notes[entry / 4u];
    }
}
