// How far a step is, for kernels that only read it.
#include "layouts/step_state.glsl"

layout(std430) readonly buffer Clock { StepClock clock[]; };

// Whether the try does. The kernels of one that is given up, and those after the end of the step, do nothing.
bool goes_on() { return clock[0].goes_on != 0u; }

// Whether it does, and not with the guard alone.
bool makes_part() { return goes_on() && clock[0].guards == 0u; }
