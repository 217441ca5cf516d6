// The rows of near pairs, by slot in the order of its pairs, and what nodes and pairs have of them. An invocation a pair.
// CPU twin: gelatin::cpu::ContactRows::add. Parity: tests/gpu/implicit/pair_rows_test.cpp.
#include "include/global_index.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/near_pairs.glsl"
#include "sim/implicit/pair_sides.glsl"
#include "sim/implicit/rows.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer pair_weights;      // PairWeight, two texels each
uniform usamplerBuffer slot_rows;         // SlotRows, a texel each
uniform usamplerBuffer row_places;        // RowPlace, a texel each
uniform usamplerBuffer known_rows;        // RowMemory, two texels each
uniform samplerBuffer surface_velocities; // of objects: of belts, whose surfaces move within themselves [m/s]
uniform samplerBuffer paces;              // BodyPace, five texels each
uniform uint object_count;
layout(std430) writeonly buffer Rows { StepRow rows[]; };
layout(std430) writeonly buffer RowNotes { RowMemory row_notes[]; };
layout(std430) buffer EntryCounts { uint next_entries[]; };            // of nodes
layout(std430) writeonly buffer RowEntries { uint row_entries[]; };    // 4 row + place of the node in it
layout(std430) writeonly buffer RowChunks { uvec2 row_chunks[]; };

PairWeight fetch_weight(uint p) {
    uvec4 a = texelFetch(pair_weights, 2 * int(p)), b = texelFetch(pair_weights, 2 * int(p) + 1);
    vec4 values = uintBitsToFloat(a);
    return PairWeight(values.x, values.y, values.z, values.w, b.x, b.y, 0u, 0u);
}

vec3 across_normal(vec3 v, vec3 normal) { return v - dot(v, normal) * normal; }

StepRow row_of(NearPair near, PairWeight own) {
    bool is_own = near.object == near.other;
    uint object = is_body(near.object) && !is_own ? near.object : object_count,
         other = is_body(near.other) && !is_own ? near.other : object_count;
    StepRow row = StepRow(near.node_0, near.node_1, near.node_2, near.node_3, row_weights(near), near.normal, own.reach,
                          own.stiffness, 0.0, touch_of(near).x, vec4(0.0), object, other, kNone, 0.0);
    float gap = near.normal.w, step = clock[0].step;
    vec3 n = near.normal.xyz;
    if (own.memory != kNone) {
        vec4 hold = uintBitsToFloat(texelFetch(known_rows, 2 * int(own.memory)));
        row.hold = vec4(across_normal(hold.xyz, n), hold.w);
        row.reach = min(own.reach, own.known_reach + own.reach * clock[0].last_step / kEasing);
    } else {
        row.hold.w = row.friction * force_of(row, max(own.there, kChordGap * min(gap, row.reach)));
        // What is found nearer than all contacts that are known of two objects has not pressed so far: with all of its reach it
        // would bring in energy.
        float nearest = uintBitsToFloat(texelFetch(slot_rows, int(near.slot)).z);
        row.reach = clamp(gap / nearest, kHardly * row.reach, row.reach);
    }
    vec3 slip = texelFetch(surface_velocities, int(near.other)).xyz - texelFetch(surface_velocities, int(near.object)).xyz;
    row.hold.xyz += row.stiffness * step * across_normal(slip, n);
    uint body = is_body(near.other) ? near.other : near.object;
    row.damping = texelFetch(paces, 5 * int(body) + 1).y / step * slope_of(row, gap);
    return row;
}

void main() {
    uint p = global_index();
    if (p >= counts[0].pairs) return;
    PairWeight own = fetch_weight(p);
    if (!(own.stiffness > 0.0)) return;
    NearPair near = fetch_pair(p);
    uvec4 place = texelFetch(row_places, int(body_count + near.slot)), nodes = nodes_of(near);  // first row, end, first chunk
    uint r = place.x + own.place;
    rows[r] = row_of(near, own);
    row_notes[r] = RowMemory(vec4(0.0), 0.0, near.first, near.is_edges != 0u ? near.second : near.other, near.is_edges);
    for (int k = 0; k < 4; ++k)
        if (near.weights[k] != 0.0) row_entries[atomicAdd(next_entries[nodes[k]], 1u)] = 4u * r + uint(k);
    if (own.place % kRowsOfChunk == 0u)
        row_chunks[place.z + own.place / kRowsOfChunk] = uvec2(r, min(r + kRowsOfChunk, place.y));
}
