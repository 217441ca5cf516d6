// The least of the objects with which each is connected: bodies by rows, or, with PAIRS, all objects by near pairs. Labels pass on
// over slots, and from where they point, until none changes. One work group.
// CPU twins: gelatin::cpu::Islands::find, gelatin::cpu::Guard::find_frames. Parity: tests/gpu/implicit/pair_rows_test.cpp.
const uint kLanes = 256u;
#include "sim/implicit/near_pairs.glsl"
layout(local_size_x = 256) in;

uniform uint object_count;
layout(std430) coherent buffer Labels { uint labels[]; };

#ifdef PAIRS
bool connects(uint s, uvec4 slot) { return slot.z < slot.w; }
#else
uniform usamplerBuffer slot_rows;  // SlotRows, a texel each
bool connects(uint s, uvec4 slot) { return is_body(slot.x) && is_body(slot.y) && texelFetch(slot_rows, int(s)).x > 0u; }
#endif

shared uint has_changed;

// What invocations wrote is visible to all of the group.
void wait_for_all() {
    memoryBarrierBuffer();
    barrier();
}

void main() {
    if (counts[0].is_full != 0u) return;
    uint lane = gl_LocalInvocationID.x, end = counts[0].slots;
    for (uint o = lane; o < object_count; o += kLanes) labels[o] = o;
    bool is_over = false;
    while (!is_over) {
        wait_for_all();
        if (lane == 0u) has_changed = 0u;
        barrier();
        for (uint s = lane; s < end; s += kLanes) {
            uvec4 slot = texelFetch(pair_slots, int(s));
            uint first = labels[slot.x], second = labels[slot.y];
            if (first == second || !connects(s, slot)) continue;
            uint least = min(first, second);
            atomicMin(labels[max(first, second)], least);
            atomicMin(labels[slot.x], least);
            atomicMin(labels[slot.y], least);
            has_changed = 1u;
        }
        wait_for_all();
        for (uint o = lane; o < object_count; o += kLanes) labels[o] = labels[labels[o]];
        is_over = has_changed == 0u;
    }
}
