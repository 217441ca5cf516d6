// Whether the guard of pairs is done: then no other pass of it goes on until guard_close.comp. One invocation.
// CPU twin: gelatin::cpu::ImplicitStep::guard. Parity: tests/gpu/implicit/pair_guard_test.cpp.
#include "layouts/near_pair.glsl"
#include "layouts/pair_guard.glsl"
#include "layouts/step_state.glsl"
layout(local_size_x = 1) in;

layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) readonly buffer Counts { PairCounts counts[]; };
layout(std430) buffer Guard { GuardState guard[]; };

void main() {
    StepClock now = clock[0];
    if (now.goes_on == 0u) return;
    ++now.guards;
    if (counts[0].is_full != 0u) {
        now.is_full = 1u;
        now.goes_on = 0u;
    } else if (guard[0].needs_again == 0u && counts[0].has_lost == 0u) {
        guard[0].is_done = 1u;
        now.goes_on = 0u;
    }
    clock[0] = now;
}
