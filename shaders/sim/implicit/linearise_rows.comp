// The tangents of an island's rows, or their chords in the first round; and by them what the inverses of bodies' blocks are. A work
// group an island.
// CPU twin: gelatin::cpu::IslandRows. Parity: tests/gpu/implicit/step_system_test.cpp.
const uint kLanes = 256u;
#include "sim/implicit/rows.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/rigid_level.glsl"
layout(local_size_x = 256) in;

uniform samplerBuffer expected;  // s where the solve began [m]
uniform uint is_first;
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) readonly buffer Slips { vec4 slips[]; };  // s [m]; w: limit of friction [N]
layout(std430) readonly buffer States { SolveState states[]; };
layout(std430) coherent buffer Tangents { StepTangent tangents[]; };

RowStiffness row_stiffness(uint r) { return RowStiffness(tangents[r].diagonal.xyz, tangents[r].beside.xyz); }

void main() {
    uint i = group_index();
    if (i >= object_count) return;
    StepIsland island = fetch_island(i);
    if (!has_rows(island) || (is_first == 0u && states[state_before(i)].is_over != 0u)) return;
    for (uint r = island.first_row + gl_LocalInvocationID.x; r < island.row_end; r += kLanes)
        tangents[r] = is_first != 0u ? chord_at(rows[r], texelFetch(expected, int(r)).xyz, slips[r].w)
                                     : tangent_at(rows[r], slips[r].xyz, slips[r].w);
    wait_for_group();
    find_matrix(island);
}
