// Where the slots of each object begin, and whether anything is searched for: not where there is no place for them, and not where
// objects go so far beside each other that the part will be halved. One work group.
// CPU twins: gelatin::cpu::FindPairs::fastest_approach, gelatin::cpu::ImplicitStep::detect.
// Parity: tests/gpu/implicit/find_pairs_test.cpp.
const uint kLanes = 256u;
#define WRITES_DISPATCHES
#include "layouts/near_pair.glsl"
#include "layouts/pair_stages.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/part_length.glsl"
layout(local_size_x = 256) in;

uniform uint object_count;
uniform uint slot_capacity;
layout(std430) buffer SlotStarts { uint slot_starts[]; };          // counts before
layout(std430) readonly buffer Speeds { float speeds[]; };         // by object [reaches]
layout(std430) writeonly buffer Counts { PairCounts counts[]; };

void main() {
    uint lane = gl_LocalInvocationID.x, count = 0u;
    float fastest = 0.0;
    for (uint base = 0u; base < object_count; base += kLanes) {
        uint o = base + lane, all;
        bool is_object = o < object_count;
        uint before = count_before(is_object ? slot_starts[o] : 0u, all);
        if (is_object) {
            slot_starts[o] = count + before;
            fastest = max(fastest, speeds[o]);
        }
        count += all;
    }
    fastest = max_over_group(fastest);
    if (lane != 0u) return;
    for (uint k = 0u; k < kPairDispatches; ++k) dispatches[k] = Dispatch(0u, 1u, 1u, 0u);
    slot_starts[object_count] = count;
    bool is_full = count > slot_capacity;
    counts[0] = PairCounts(count, 0u, 0u, 0u, fastest, is_full ? 1u : 0u, 0u, 0u);
    StepClock now = clock[0];
    if (is_full || (now.guards == 0u && fastest > kFastest && !is_shortest(now))) return;
    dispatches[2u * kOfSlots] = make_dispatch(count, count);
    dispatches[2u * kOfSlots + 1u] = make_dispatch(count, count / kCountsAGroup + 1u);
}
