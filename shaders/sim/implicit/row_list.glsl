#include "layouts/step_rows.glsl"

layout(std430) readonly buffer Rows { StepRow rows[]; };
