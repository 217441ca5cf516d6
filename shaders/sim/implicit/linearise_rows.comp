// The tangents of a large island's rows, or their chords in the first round; and by them what the inverses of bodies' blocks are. A
// work group an island.
// CPU twin: gelatin::cpu::IslandRows. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "sim/implicit/island_lanes.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/row_list.glsl"
layout(local_size_x = LANES) in;

uniform uint is_first;
layout(std430) readonly buffer Slips { vec4 slips[]; };  // s [m]; w: limit of friction [N]
layout(std430) readonly buffer States { SolveState states[]; };
#include "sim/implicit/row_tangents.glsl"
#include "sim/implicit/rigid_bodies.glsl"

void main() {
    uint i = group_index();
    if (i >= object_count) return;
    StepIsland island = fetch_island(i);
    if (is_small(island) || !has_rows(island) || (is_first == 0u && states[state_before(i)].is_over != 0u)) return;
    linearise(island, is_first != 0u);
}
