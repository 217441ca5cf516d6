// How far a step is, for kernels that only read it.
#include "layouts/step_state.glsl"

layout(std430) readonly buffer Clock { StepClock clock[]; };
