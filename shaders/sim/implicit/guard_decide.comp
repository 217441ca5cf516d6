// Whether the guard of pairs is done, after which the part ends. If not, the next try goes on with the guard alone; after some of
// these the part is halved, and in the shortest one nothing moves. One work group.
// CPU twin: gelatin::cpu::ImplicitStep::guard. Parity: tests/gpu/implicit/pair_guard_test.cpp.
#include "layouts/near_pair.glsl"
#include "layouts/pair_guard.glsl"
#include "sim/implicit/part_choices.glsl"
#include "sim/implicit/tries.glsl"
layout(local_size_x = 64) in;

uniform uint most_guards;  // in this part
layout(std430) readonly buffer Counts { PairCounts counts[]; };
layout(std430) buffer Guard { GuardState guard[]; };

void main() {
    StepClock now = clock[0];
    uint guards = now.guards + 1u;
    now.guards = 0u;
    bool stays = false;
    if (counts[0].is_full != 0u) {
        now.is_full = 1u;
        now.goes_on = 0u;
    } else if (guard[0].needs_again != 0u || counts[0].has_lost != 0u) {
        if (guards < most_guards) {
            now.guards = guards;
            now.goes_on = 0u;
        } else if (is_shortest(now)) {
            stays = true;
        } else {
            now = halved(now);
        }
    }
    memoryBarrierBuffer();
    barrier();  // all have read it
    set_clock(now);
    if (!stays || gl_LocalInvocationIndex != 0u) return;
    guard[0].is_changed = guard[0].is_given_up = 1u;
    dispatches[kGuardStays].groups_x = dispatches[kGuardStays].count;  // guard_stay.comp
}
