// What contacts exert where the last part ends, normal force and friction, for who reads forces; one invocation a row.
// CPU twin: gelatin::cpu::ImplicitStep::finish. Parity: tests/gpu/implicit/implicit_solver_test.cpp.
#include "include/global_index.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/rows.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer displacements;  // d, xyz [m]
uniform samplerBuffer slips;          // w: limit of friction [N]
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) writeonly buffer RowForces { vec4 row_forces[]; };  // two a row, on the second side [N]

void main() {
    uint r = global_index();
    if (r >= clock[0].row_count) return;
    StepRow row = rows[r];
    vec3 s = relative(row, displacements), normal = pressing(row, s) * row.normal.xyz;
    row_forces[2u * r] = vec4(normal, 0.0);
    row_forces[2u * r + 1u] = vec4(force_at(row, s, texelFetch(slips, int(r)).w) - normal, 0.0);
}
