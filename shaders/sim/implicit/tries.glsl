// The clock of a try, and by it the arguments of its dispatches: what does not apply has no work groups.
#include "layouts/dispatch.glsl"
#include "layouts/step_state.glsl"
#include "layouts/tries.glsl"

layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) buffer Dispatches { Dispatch dispatches[]; };

// Called by all invocations of a work group of kTryDispatches or more, with the same clock.
void set_clock(StepClock now) {
    uint d = gl_LocalInvocationIndex;
    if (d == 0u) clock[0] = now;
    if (d >= kTryDispatches) return;
    bool applies = now.goes_on != 0u && (d < kFirstSize || d % 2u == 1u || now.guards == 0u);
    if (!applies) dispatches[d].groups_x = 0u;
    else if (d >= kFirstSize) dispatches[d].groups_x = dispatches[d].count;
}
