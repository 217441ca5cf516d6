// The tangents of an island's rows, for its work group, which makes them.
// CPU twin: gelatin::cpu::IslandRows.
#include "sim/implicit/rows.glsl"
#include "sim/implicit/rigid_level.glsl"

// Before the first linearisation the constant of each is s where the solve began [m].
layout(std430) coherent buffer Tangents { StepTangent tangents[]; };

RowStiffness row_stiffness(uint r) { return RowStiffness(tangents[r].diagonal.xyz, tangents[r].beside.xyz); }

// Chords in the first linearisation; and by them the inverses of bodies' blocks.
void linearise(StepIsland island, bool is_first) {
    for (uint r = island.first_row + gl_LocalInvocationID.x; r < island.row_end; r += kLanes)
        tangents[r] = is_first ? chord_at(rows[r], tangents[r].constant.xyz, slips[r].w)
                               : tangent_at(rows[r], slips[r].xyz, slips[r].w);
    wait_for_group();
    find_matrix(island);
}
