// Whether the guard of pairs is done: else this try ends, and the next one goes on with it. One that has run too often lets nothing move.
// One invocation. CPU twin: gelatin::cpu::ImplicitStep::guard. Parity: tests/gpu/implicit/pair_guard_test.cpp.
#define WRITES_DISPATCHES
#include "layouts/contact_tuning.glsl"
#include "layouts/near_pair.glsl"
#include "layouts/pair_guard.glsl"
#include "layouts/step_state.glsl"
#include "sim/collision/dispatches.glsl"
layout(local_size_x = 1) in;

layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) readonly buffer Counts { PairCounts counts[]; };
layout(std430) buffer Guard { GuardState guard[]; };

void main() {
    if (clock[0].goes_on == 0u) return;
    uint guards = clock[0].guards + 1u;
    clock[0].guards = 0u;
    if (guard[0].needs_again == 0u && counts[0].has_lost == 0u) return;
    if (guards < kMostGuards) {
        clock[0].guards = guards;
        clock[0].goes_on = 0u;
        return;
    }
    guard[0].is_changed = guard[0].is_given_up = 1u;
    uint last = 2u * kGuardRounds + 1u;  // guard_stay.comp
    dispatches[last].groups_x = dispatches[last].count;
}
