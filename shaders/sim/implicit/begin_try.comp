// Where a try of a part begins, if the step is not over: its length, and what is launched. One work group.
// CPU twin: gelatin::cpu::SystemSolver, gelatin::cpu::ImplicitStep::run. Parity: tests/gpu/implicit/part_start_test.cpp.
#include "sim/implicit/part_length.glsl"
#include "sim/implicit/tries.glsl"
layout(local_size_x = 64) in;

void main() {
    StepClock now = clock[0];
    now.goes_on = now.is_over == 0u && now.is_full == 0u ? 1u : 0u;
    if (now.goes_on != 0u) {
        ++now.tries;
        if (now.begun == now.made) now.step = min(now.left, now.longest);  // else it is as the try before has left it
        now.begun = now.made + 1u;
        now.step = shortened(now, now.parts);
    }
    memoryBarrierBuffer();
    barrier();  // all have read it
    set_clock(now);
}
