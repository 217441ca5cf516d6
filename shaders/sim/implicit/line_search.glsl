// How far along a direction the objective falls, of an island whose work group this is, and by at most all of it.
// CPU twin: gelatin::cpu::IslandRows::line_search.
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/row_list.glsl"
#include "sim/implicit/rows.glsl"

layout(std430) coherent buffer Slips { vec4 slips[]; };  // s [m]; w: limit of friction [N]

vec3 change_of(uint r);  // of a slip, along all of the direction; of a kernel [m]

// Minus the gradient along the direction [J].
float fall_at(StepIsland island, float base, float curvature, float t) {
    float sum = 0.0;
    for (uint r = island.first_row + gl_LocalInvocationID.x; r < island.row_end; r += kLanes) {
        vec3 change = change_of(r);
        sum += dot(change, force_at(rows[r], slips[r].xyz + t * change, slips[r].w));
    }
    return sum_over_group(sum) + base - t * curvature;
}

// @param base what pulls along the direction without rows, and by how much less it does so at its end [J]
// One loop, so that the sum is compiled once.
float line_search(StepIsland island, float base, float curvature) {
    float first = 0.0, low = 0.0, high = 1.0, t = 0.0;
    for (uint k = 0u; k < kMostRounds + 2u; ++k) {
        float there = fall_at(island, base, curvature, t);
        if (k == 0u) {
            if (!(there > 0.0)) return 0.0;
            first = there;
            t = 1.0;
            continue;
        }
        if (k == 1u ? there >= -kNearly * first : abs(there) <= kNearly * first) return t;
        if (there > 0.0)
            low = t;
        else
            high = t;
        t = 0.5 * (low + high);
    }
    return t;
}
