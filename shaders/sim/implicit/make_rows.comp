// The rows of nodes near colliders, which count_rows.comp has noted, in the order of nodes, and what nodes and pairs have of them. With
// PAIRS there are others, and start_entries.comp has found where those of a node go. A work group a chunk.
// CPU twin: gelatin::cpu::ContactRows::add. Parity: tests/gpu/implicit/part_start_test.cpp, pair_rows_test.cpp.
const uint kLanes = 64u;
#include "layouts/packing.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/node_chunks.glsl"
#include "sim/implicit/plane_contacts.glsl"
#include "sim/implicit/rows.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer chunk_rows;  // ChunkRows, a texel each
uniform usamplerBuffer body_rows;   // BodyRows, a texel each
uniform usamplerBuffer islands;     // StepIsland, three texels each
uniform samplerBuffer paces;        // BodyPace, five texels each
uniform uint object_count;
uniform uint row_capacity;
layout(std430) readonly buffer PlaneNotes { PlaneMemory plane_notes[]; };
layout(std430) writeonly buffer Rows { StepRow rows[]; };
layout(std430) writeonly buffer RowEntries { uint row_entries[]; };    // 4 row + place of the node in it
layout(std430) writeonly buffer RowChunks { uvec2 row_chunks[]; };

#ifdef PAIRS
#include "layouts/near_pair.glsl"
uniform usamplerBuffer row_places;  // RowPlace, a texel each
layout(std430) buffer EntryCounts { uint next_entries[]; };  // of nodes
layout(std430) writeonly buffer RowNotes { RowMemory row_notes[]; };

void begin_node(uint n, uint r) {}
void end_nodes(uint n) {}
void add_entry(uint n, uint r) {
    row_entries[atomicAdd(next_entries[n], 1u)] = 4u * r;
    row_notes[r] = RowMemory(vec4(0.0), 0.0, kNone, kNone, kNone);  // no pair's
}
// Of a body: first row, end, first chunk of rows.
uvec4 place_of(uint body) { return texelFetch(row_places, int(body)); }
#else
layout(std430) writeonly buffer EntryStarts { uint entry_starts[]; };  // of each node, and the end

void begin_node(uint n, uint r) { entry_starts[n] = min(r, row_capacity); }
void end_nodes(uint n) { entry_starts[n] = clock[0].row_count; }
void add_entry(uint n, uint r) { row_entries[r] = 4u * r; }
uvec4 place_of(uint body) { return texelFetch(islands, 3 * int(body) + 1); }
#endif

StepRow row_of(uint c, uint n, PlaneMemory note, uint body) {
    PlaneMemory memory = plane_memories[c * body_nodes + n];
    vec4 surface = distance_to_collider(c, texelFetch(positions, int(n)).xyz);
    vec4 expected = texelFetch(predicted, int(n));
    float gap = surface.w + note.ease, thickness = texelFetch(thicknesses, int(body)).x;
    float friction = texelFetch(colliders, 4 * int(c) + 3).y;
    StepRow row = StepRow(n, 0u, 0u, 0u, vec4(1.0, 0.0, 0.0, 0.0), vec4(surface.xyz, gap), note.reach, 4.0 / expected.w, 0.0,
                          friction, vec4(0.0), object_count, body, c, note.ease);
    if (memory.reach > 0.0) {
        row.hold = vec4(memory.hold.xyz - dot(memory.hold.xyz, surface.xyz) * surface.xyz, memory.hold.w);
    } else {
        float there = gap + dot(surface.xyz, expected.xyz);
        row.hold.w = friction * force_of(row, max(there, kChordGap * min(gap, row.reach)));
        // What is found nearer than all contacts that are known has not pressed so far: with all of its reach it would bring in
        // energy.
        float nearest = uintBitsToFloat(texelFetch(body_rows, int(body)).z);
        row.reach = clamp(gap / nearest, kHardly * row.reach, row.reach);
    }
    row.damping = texelFetch(paces, 5 * int(body) + 1).y / clock[0].step * slope_of(row, gap);
    return row;
}

// Of a body, whose pair has them in chunks.
void write_row(uint n, uint r, StepRow row, uvec2 of_body, uint first_chunk) {
    rows[r] = row;
    add_entry(n, r);
    uint before = r - of_body.x;
    if (before % kRowsOfChunk == 0u)
        row_chunks[first_chunk + before / kRowsOfChunk] = uvec2(r, min(r + kRowsOfChunk, of_body.y));
}

void main() {
    uint chunk_number = group_index();
    if (chunk_number >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(chunk_number));
    bool is_body = chunk.x < body_count;
    uvec4 place = place_of(chunk.x);
    uint next = is_body ? place.x + texelFetch(chunk_rows, int(chunk_number)).y : clock[0].row_count;
    for (uint k = gl_LocalInvocationID.x; k - gl_LocalInvocationID.x < chunk.z; k += kLanes) {
        uint n = chunk.y + k, count = 0u, all, end = is_body && k < chunk.z ? collider_ends.w : 0u;
        for (uint c = 0u; c < end; ++c) count += plane_notes[c * body_nodes + n].reach > 0.0 ? 1u : 0u;
        uint r = next + count_before(count, all);
        next += all;
        if (k < chunk.z) begin_node(n, r);
        for (uint c = 0u; c < end; ++c) {
            PlaneMemory note = plane_notes[c * body_nodes + n];
            if (!(note.reach > 0.0)) continue;
            if (r < place.y) write_row(n, r, row_of(c, n, note, chunk.x), place.xy, place.z);
            ++r;
        }
    }
    bool is_last = chunk_number + 1u == chunk_count && gl_LocalInvocationID.x == 0u;
    if (is_last) end_nodes(chunk.y + chunk.z);
}
