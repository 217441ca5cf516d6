// What the bodies of an island have in common where a part begins: how they move on, what holds them, and by which scheme they go on.
// A work group an island.
// CPU twins: gelatin::cpu::Islands::find, gelatin::cpu::Paces::choose. Parity: tests/gpu/implicit/pair_rows_test.cpp.
const uint kLanes = 64u;
#include "include/global_index.glsl"
#include "sim/implicit/common_motion.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/near_pairs.glsl"
#include "sim/implicit/part_choices.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer islands;        // StepIsland, three texels each
uniform usamplerBuffer island_bodies;
uniform usamplerBuffer body_touches;   // BodyTouch, two texels each
uniform usamplerBuffer body_places;    // BodyPlace, a texel each
uniform samplerBuffer wave_times;      // of bodies [s]
uniform uint has_forces;               // 1: loads or hands act
layout(std430) readonly buffer StartsOfBodies { StartSums body_starts[]; };
layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) buffer Paces { BodyPace paces[]; };

void main() {
    uint i = group_index();
    if (i >= body_count) return;
    uint first = texelFetch(islands, 3 * int(i)).x, end = texelFetch(islands, 3 * int(i)).y;
    StepClock now = clock[0];
    StartSums sums = StartSums(vec4(0.0), vec4(0.0), 0.0, 0.0, 0.0, 0.0);
    vec4 marks = vec4(0.0);  // bodies that touch something, that touch what is no body, that are struck, that the part resolves
    float pace = float(kStill);
    for (uint k = first + gl_LocalInvocationID.x; k < end; k += kLanes) {
        uint o = texelFetch(island_bodies, int(k)).x;
        uvec4 touch = texelFetch(body_touches, 2 * int(o));
        sums.momentum += body_starts[o].momentum;
        sums.carried += body_starts[o].carried;
        sums.held_count += body_starts[o].held_count;
        marks += vec4(min(touch.x + touch.w, 1u), texelFetch(body_touches, 2 * int(o) + 1).y, paces[o].is_struck,
                      texelFetch(wave_times, int(o)).x > now.step ? 1u : 0u);
        pace = min(pace, float(paces[o].pace));
    }
    sums.momentum = sum_over_group(sums.momentum);
    sums.carried = sum_over_group(sums.carried);
    sums.held_count = sum_over_group(sums.held_count);
    bvec4 any_ = greaterThan(sum_over_group(marks), vec4(0.0));
    uint slowest = uint(-max_over_group(-pace));
    bool is_driven = any_.y || has_forces != 0u, goes_on = has_past_scheme(now, slowest, any_.z, any_.x, any_.w);
    for (uint k = first + gl_LocalInvocationID.x; k < end; k += kLanes) {
        uint o = texelFetch(island_bodies, int(k)).x, row = texelFetch(body_places, int(o)).x;
        paces[o].is_held = is_driven || sums.held_count > 0.0 ? 1u : 0u;
        paces[o].past = goes_on ? 1.0 : 0.0;
        paces[o].damping = least_damping(goes_on, slowest);
        paces[o].first_row = row;
        paces[o].row_end = row + texelFetch(body_touches, 2 * int(o)).x;
        paces[o].velocity = vec4(common_motion(sums, is_driven).xyz, body_starts[o].momentum.w);
    }
    if (goes_on && gl_LocalInvocationID.x == 0u && first < end) atomicOr(clock[0].has_past, 1u);
}
