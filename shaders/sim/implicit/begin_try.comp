// Where a try of a part begins, if the step is not over: its length, and what is launched. One work group.
// CPU twin: gelatin::cpu::SystemSolver, gelatin::cpu::ImplicitStep::run. Parity: tests/gpu/implicit/part_start_test.cpp.
#include "layouts/rest_state.glsl"
#include "sim/implicit/part_length.glsl"
#include "sim/implicit/tries.glsl"
layout(local_size_x = 64) in;

uniform uint sleeps;  // 1: bodies may
layout(std430) buffer Rest { RestState rest[]; };

// In the first try of a step. @return what it is for the others
RestState begin_rest(float size) {
    RestState now = rest[0];
    now.takes_places = now.is_restless;
    if (now.is_restless != 0u) now.time = 0.0;
    now.rests = sleeps != 0u && now.time >= kSleepTime ? 1u : 0u;
    now.time += size;
    now.is_restless = 0u;
    return now;
}

void main() {
    StepClock now = clock[0];
    RestState resting = rest[0];
    if (now.tries == 0u) {
        resting = begin_rest(now.size);
        if (resting.rests != 0u) now.is_over = 1u;
    }
    now.goes_on = now.is_over == 0u && now.is_full == 0u ? 1u : 0u;
    if (now.goes_on != 0u) {
        ++now.tries;
        if (now.begun == now.made) now.step = min(now.left, now.longest);  // else it is as the try before has left it
        now.begun = now.made + 1u;
        now.step = shortened(now, now.parts);
    }
    memoryBarrierBuffer();
    barrier();  // all have read both
    if (gl_LocalInvocationIndex == 0u) rest[0] = resting;
    set_clock(now);
}
