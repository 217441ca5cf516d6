// Of which pairs each body is a side: of each of its slots, of the slots the other way round, and of planes. A work group a body.
// Host: gpu::RowTables. Parity: tests/gpu/implicit/pair_rows_test.cpp.
const uint kLanes = 64u;
#include "include/global_index.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/near_pairs.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer slot_starts;      // of each object, and the end
uniform usamplerBuffer slot_rows;        // SlotRows, a texel each
uniform usamplerBuffer row_places;       // RowPlace, a texel each
uniform usamplerBuffer coupling_starts;  // of each object, and the end
layout(std430) writeonly buffer Couplings { uint couplings[]; };  // 2 pair + side

// 1 if it has rows.
uint couples(uint place) {
    uvec4 rows = texelFetch(row_places, int(place));
    return rows.x < rows.y ? 1u : 0u;
}
uint pair_of(uint place) { return texelFetch(row_places, int(place)).w; }

void main() {
    uint o = group_index(), all;
    if (o >= body_count) return;
    uint next = texelFetch(coupling_starts, int(o)).x, end = texelFetch(slot_starts, int(o) + 1).x;
    for (uint base = texelFetch(slot_starts, int(o)).x; base < end; base += kLanes) {
        uint s = base + gl_LocalInvocationID.x, count = 0u, twin = kNone, twin_count = 0u;
        if (s < end && texelFetch(pair_slots, int(s)).y != o) {
            count = couples(body_count + s);
            twin = texelFetch(slot_rows, int(s)).y;
            if (twin != kNone) twin_count = couples(body_count + twin);
        }
        uint at = next + count_before(count + twin_count, all);
        next += all;
        if (count > 0u) couplings[at] = 2u * pair_of(body_count + s);
        if (twin_count > 0u) couplings[at + count] = 2u * pair_of(body_count + twin) + 1u;
    }
    if (gl_LocalInvocationID.x == 0u && couples(o) > 0u) couplings[next] = 2u * pair_of(o) + 1u;
}
