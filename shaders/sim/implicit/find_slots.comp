// Which objects are near each object, in ascending order: how many, and the greatest speed beside one of them; with LIST the slots.
// Objects are near whose boxes, over all that they do, meet; one of both is a body. A work group an object.
// CPU twin: gelatin::cpu::FindPairs. Parity: tests/gpu/implicit/find_pairs_test.cpp.
const uint kLanes = 64u;
#include "include/global_index.glsl"
#include "layouts/near_pair.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/own_pairs.glsl"
layout(local_size_x = 64) in;

uniform uint object_count;
uniform uint body_count;
#ifdef LIST
layout(std430) readonly buffer Counts { PairCounts counts[]; };
layout(std430) readonly buffer SlotStarts { uint slot_starts[]; };
layout(std430) writeonly buffer PairSlots { PairSlot slots[]; };
#else
layout(std430) writeonly buffer SlotStarts { uint slot_starts[]; };  // counts
layout(std430) buffer Speeds { float speeds[]; };                    // by object [reaches]
#endif

bool is_body(uint object) { return object < body_count; }

void main() {
    uint o = group_index(), lane = gl_LocalInvocationID.x;
    if (o >= object_count) return;
#ifdef LIST
    if (counts[0].is_full != 0u) return;
    uint place = slot_starts[o];
#endif
    Bounds box = bounds_of(o);
    vec3 motion = motion_of(o);
    float fastest = 0.0, thickness = thickness_of(o);
    uint count = 0u;
    for (uint base = 0u; base < object_count; base += kLanes) {
        uint other = base + lane, all;
        bool is_near = false;
        if (other == o) {
            is_near = is_body(o) && may_meet_itself(o);
        } else if (other < object_count && (is_body(o) || is_body(other)) && meet(box, bounds_of(other))) {
            is_near = true;
            fastest = max(fastest, distance(motion, motion_of(other)) / (thickness + thickness_of(other)));
        }
        uint before = count_before(is_near ? 1u : 0u, all);
#ifdef LIST
        if (is_near) slots[place + count + before] = PairSlot(o, other, 0u, 0u);
#endif
        count += all;
    }
#ifndef LIST
    fastest = max_over_group(fastest);
    if (lane != 0u) return;
    slot_starts[o] = count;
    speeds[o] = max(speeds[o], fastest);
#endif
}
