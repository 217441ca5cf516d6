// Which nodes are or come near colliders, and how far what lies inside of one is pushed out; by chunk how many. A work group a chunk.
// CPU twin: gelatin::cpu::ContactRows::add. Parity: tests/gpu/implicit/part_start_test.cpp.
const uint kLanes = 64u;
#include "layouts/contact_tuning.glsl"
#include "sim/implicit/node_chunks.glsl"
#include "sim/implicit/plane_contacts.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer PlaneNotes { PlaneMemory plane_notes[]; };  // reach: 0 where there is no contact
layout(std430) writeonly buffer RowsOfChunks { ChunkRows chunk_rows[]; };

void main() {
    uint chunk_number = group_index(), lane = gl_LocalInvocationID.x;
    if (chunk_number >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(chunk_number));
    if (chunk.x >= body_count) return;
    float thickness = texelFetch(thicknesses, int(chunk.x)).x;
    float step = clock[0].step, last_step = clock[0].last_step, count = 0.0, nearest = 1.0, deepest = 0.0;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += kLanes) {
        vec4 expected = texelFetch(predicted, int(n));
        for (uint c = 0u; c < collider_ends.w; ++c) {
            PlaneMemory memory = plane_memories[c * body_nodes + n], note = PlaneMemory(vec4(0.0), 0.0, 0.0, 0.0, 0.0);
            vec4 surface = distance_to_collider(c, texelFetch(positions, int(n)).xyz);
            bool is_known = memory.reach > 0.0;
            if (is_known)
                note.ease = memory.ease * max(0.0, 1.0 - step / kImpactTime);
            else if (surface.w <= 0.0)
                note.ease = kHardly * thickness - surface.w;
            float motion = dot(surface.xyz, expected.xyz), gap = surface.w + note.ease, there = gap + motion;
            if (expected.w > 0.0 && surface.w + min(0.0, motion) <= (1.0 + kPathSlack) * thickness) {
                note.reach = thickness;
                if (is_known) {
                    float reach = known_reach(memory, thickness, gap);
                    nearest = min(nearest, gap / reach);
                    note.reach = min(thickness, reach + thickness * last_step / kEasing);
                }
                count += 1.0;
                deepest = max(deepest, -there / thickness);
            }
            plane_notes[c * body_nodes + n] = note;
        }
    }
    count = sum_over_group(count);
    nearest = -max_over_group(-nearest);
    deepest = max_over_group(deepest);
    if (lane == 0u) chunk_rows[chunk_number] = ChunkRows(uint(count), 0u, nearest, deepest);
}
