// After the last pass of the guard of pairs: a part for which it has found no way is halved; in the shortest one nothing moves. One
// invocation. CPU twin: gelatin::cpu::ImplicitStep::guard. Parity: tests/gpu/implicit/pair_guard_test.cpp.
#define WRITES_DISPATCHES
#include "layouts/pair_guard.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/implicit/part_choices.glsl"
layout(local_size_x = 1) in;

layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) buffer Guard { GuardState guard[]; };

void main() {
    StepClock now = clock[0];
    now.guards = 0u;
    if (guard[0].is_done != 0u) {
        guard[0].is_done = 0u;
        now.goes_on = 1u;
    } else if (now.goes_on != 0u && !is_shortest(now)) {
        now = halved(now);
    } else if (now.goes_on != 0u) {
        guard[0].is_changed = guard[0].is_given_up = 1u;
        uint last = 2u * kGuardRounds + 1u;  // guard_stay.comp
        dispatches[last].groups_x = dispatches[last].count;
    }
    clock[0] = now;
}
