// Where the rows of each slot and those with planes go in the tables, and what these have by pair and body: after each slot of a
// body that of a collider with it, then planes. A work group a body.
// Host: gpu::RowTables. Parity: tests/gpu/implicit/pair_rows_test.cpp.
const uint kLanes = 64u;
#include "layouts/contact_tuning.glsl"
#include "layouts/step_rows.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/near_pairs.glsl"
#include "sim/implicit/node_chunks.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer slot_starts;   // of each object, and the end
uniform usamplerBuffer slot_rows;     // SlotRows, a texel each
uniform usamplerBuffer body_touches;  // BodyTouch, two texels each
uniform usamplerBuffer body_places;   // BodyPlace, a texel each
uniform uint object_count;
layout(std430) writeonly buffer RowPlaces { RowPlace row_places[]; };  // of planes by body, then by slot
layout(std430) writeonly buffer Pairs { StepPair pairs[]; };
layout(std430) writeonly buffer IslandChunks { uint island_chunks[]; };

uvec3 in_tables(uint count) { return uvec3(count, min(count, 1u), (count + kRowsOfChunk - 1u) / kRowsOfChunk); }

// @param at row, pair, chunk of rows
void put(uint place, uvec3 at, uint count, uvec2 sides) {
    row_places[place] = RowPlace(at.x, at.x + count, at.z, at.y);
    if (count == 0u) return;
    bool is_own = sides.x == sides.y;  // does not move a body as a rigid one
    uint object = is_body(sides.x) && !is_own ? sides.x : object_count, other = is_body(sides.y) && !is_own ? sides.y : object_count;
    pairs[at.y] = StepPair(object, other, at.z, at.z + in_tables(count).z);
}

void main() {
    uint o = group_index(), lane = gl_LocalInvocationID.x;
    if (o >= body_count) return;
    uvec4 place = texelFetch(body_places, int(o));
    uvec3 next = place.xyz, all;
    uint end = texelFetch(slot_starts, int(o) + 1).x;
    for (uint base = texelFetch(slot_starts, int(o)).x; base < end; base += kLanes) {
        uint s = base + lane, other = o, count = 0u, twin = kNone, twin_count = 0u;
        if (s < end) {
            other = texelFetch(pair_slots, int(s)).y;
            count = texelFetch(slot_rows, int(s)).x;
            if (!is_body(other)) twin = texelFetch(slot_rows, int(s)).y;
            if (twin != kNone) twin_count = texelFetch(slot_rows, int(twin)).x;
        }
        uvec3 own = in_tables(count), both = own + in_tables(twin_count), at;
        at.x = next.x + count_before(both.x, all.x);
        at.y = next.y + count_before(both.y, all.y);
        at.z = next.z + count_before(both.z, all.z);
        next += all;
        if (s < end) put(body_count + s, at, count, uvec2(o, other));
        if (twin != kNone) put(body_count + twin, at + own, twin_count, uvec2(other, o));
    }
    if (lane == 0u) put(o, next, texelFetch(body_touches, 2 * int(o) + 1).x, uvec2(kNone, o));
    uint first = texelFetch(chunk_starts, int(o)).x, chunks_end = texelFetch(chunk_starts, int(o) + 1).x;
    for (uint c = first + lane; c < chunks_end; c += kLanes) island_chunks[place.w + c - first] = c;
}
