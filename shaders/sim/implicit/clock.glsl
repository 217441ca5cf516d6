// How far a step is, for kernels that only read it.
#include "layouts/step_state.glsl"

layout(std430) readonly buffer Clock { StepClock clock[]; };

// Whether the try that this kernel is a part of does. What is left of one that is given up does nothing.
bool goes_on() { return clock[0].goes_on != 0u; }
