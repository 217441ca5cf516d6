// Rows where a solve begins, a work group an island: how their sides move relative to each other by the displacements, what friction
// holds with at most, and where they are on their bodies as rigid ones.
// CPU twin: gelatin::cpu::RigidSolve. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "sim/implicit/rows.glsl"
#include "sim/implicit/solve_system.glsl"
layout(local_size_x = 256) in;

uniform samplerBuffer displacements;  // d, xyz [m]
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) writeonly buffer Slips { vec4 slips[]; };        // s [m]; w: limit of friction [N]
layout(std430) writeonly buffer Expected { vec4 expected[]; };  // s [m]
layout(std430) writeonly buffer Arms { vec4 arms[]; };          // of both sides of each row, from the bodies' centres [m]

// 0 on a body that does not move as a rigid one.
vec3 arm_of(StepRow row, uint object, bool is_first) {
    vec3 arm = vec3(0.0);
    if (object >= object_count || !(texelFetch(bodies, 5 * int(object)).w > 0.0)) return arm;
    uvec4 nodes = nodes_of(row);
    for (int k = 0; k < 4; ++k)
        if (row.weights[k] != 0.0 && (row.weights[k] < 0.0) == is_first)
            arm += abs(row.weights[k]) * (texelFetch(positions, int(nodes[k])).xyz - center_of(object));
    return arm;
}

void begin(uint r) {
    StepRow row = rows[r];
    vec3 s = relative(row, displacements);
    slips[r] = vec4(s, row.hold.w);
    expected[r] = vec4(s, 0.0);
    arms[2u * r] = vec4(arm_of(row, row.object, true), 0.0);
    arms[2u * r + 1u] = vec4(arm_of(row, row.other, false), 0.0);
}

void main() {
    uint i = group_index();
    if (i >= object_count) return;
    StepIsland island = fetch_island(i);
    for (uint r = island.first_row + gl_LocalInvocationID.x; r < island.row_end; r += 256u) begin(r);
}
