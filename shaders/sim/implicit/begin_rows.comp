// Rows where a solve begins, a work group an island: how their sides move relative to each other by the displacements, what friction
// holds with at most, and where they are on their bodies as rigid ones. Of small islands what all but rows exerts on bodies, too.
// CPU twin: gelatin::cpu::RigidSolve. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "sim/implicit/island_lanes.glsl"
#include "sim/implicit/row_list.glsl"
#include "sim/implicit/rows.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/base_sums.glsl"
#include "sim/implicit/group_residuals.glsl"
#include "sim/implicit/row_arms.glsl"
layout(local_size_x = LANES) in;

uniform samplerBuffer displacements;  // d, xyz [m]
layout(std430) writeonly buffer Slips { vec4 slips[]; };  // s [m]; w: limit of friction [N]
layout(std430) writeonly buffer Tangents { StepTangent tangents[]; };
layout(std430) writeonly buffer Arms { vec4 arms[]; };  // of both sides of each row, from the bodies' centres [m]

void begin(uint r) {
    StepRow row = rows[r];
    vec3 s = relative(row, displacements);
    slips[r] = vec4(s, row.hold.w);
    tangents[r].constant = vec4(s, 0.0);
    arms[2u * r] = vec4(arm_of(row, row.object, true), 0.0);
    arms[2u * r + 1u] = vec4(arm_of(row, row.other, false), 0.0);
}

vec3 base_at(uint n, uint island, vec4 load) { return first_base(load, texelFetch(displacements, int(n)).xyz); }

void main() {
    uint i = group_index();
    if (i >= object_count) return;
    StepIsland island = fetch_island(i);
    for (uint r = island.first_row + gl_LocalInvocationID.x; r < island.row_end; r += kLanes) begin(r);
    if (!is_small(island) || !has_rows(island)) return;
    for (uint k = island.first_chunk; k < island.chunk_end; ++k) sum_base(texelFetch(island_chunks, int(k)).x, i);
}
