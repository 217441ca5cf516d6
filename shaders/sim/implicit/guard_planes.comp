// Nodes go no farther into colliders than they were, and keep a part of their gaps; a work group a chunk.
// CPU twins: gelatin::cpu::Guard, ImplicitStep::stop_guarded. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kSums = 8u;  // kGuardSums
#include "sim/implicit/clock.glsl"
#include "sim/collision/colliders.glsl"
#include "sim/implicit/lane_sums.glsl"
#include "sim/implicit/rows.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/guard_sums.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer displacements;  // d, xyz [m]
uniform samplerBuffer thicknesses;    // of objects [m]
layout(std430) readonly buffer FinishSums { double finish_sums[]; };  // by chunk
layout(std430) buffer EndPositions { vec4 end_positions[]; };

shared double body_sums[4];  // mass, mass times displacement

// What a free body's nodes have in common [m]. It does not go into a plane as a whole.
vec3 frame_of(uint object) {
    uint lane = gl_LocalInvocationID.x, end = texelFetch(chunk_starts, int(object) + 1).x;
    if (lane < 4u) {
        uint k = lane == 0u ? kMass : kMoved + lane - 1u;
        double sum = 0.0LF;
        for (uint c = texelFetch(chunk_starts, int(object)).x; c < end; ++c) sum += finish_sums[c * kFinishSums + k];
        body_sums[lane] = sum;
    }
    barrier();
    if (!(texelFetch(bodies, 5 * int(object)).w > 0.0)) return vec3(0.0);
    vec3 frame = vec3(dvec3(body_sums[1], body_sums[2], body_sums[3]) / body_sums[0]);
    for (uint p = 0u; p < collider_ends.x; ++p) {
        vec3 normal = collider_center(p).xyz;
        frame -= min(dot(normal, frame), 0.0) * normal;
    }
    return frame;
}

// A half space for the displacement in the frame: n . d <= w. Of a collider that a node does not come too near to w is infinite.
vec4 half_space(uint p, vec3 from, vec3 to, float thickness, vec3 frame) {
    vec4 start = distance_to_collider(p, from);
    float least = min(min(kLeastOfReach * thickness, kLeastOfGap * start.w), start.w);
    if (distance_to_collider(p, to).w >= least) return vec4(0.0, 0.0, 0.0, 1e30);
    return vec4(-start.xyz, start.w - least + dot(start.xyz, frame));
}

// @param d wanted in the frame @return what the half spaces leave of it; w: whether there are any
vec4 place(vec3 from, vec3 to, float thickness, vec3 frame) {
    vec3 d = to - from - frame;
    float tiny = 1e-6 * length(d), part = 1.0;
    bool any = false, is_outside = true;
    for (uint k = 0u; k < kProjections && is_outside; ++k) {
        is_outside = false;
        for (uint p = collider_ends.w; p-- > 0u;) {  // the last first
            vec4 space = half_space(p, from, to, thickness, frame);
            if (space.w >= 1e30) continue;
            any = true;
            float over = dot(space.xyz, d) - space.w;
            if (!(over > tiny)) continue;
            d -= over * space.xyz;
            is_outside = true;
        }
    }
    for (uint p = 0u; any && p < collider_ends.w; ++p) {
        vec4 space = half_space(p, from, to, thickness, frame);
        float along = dot(space.xyz, d);
        if (along > space.w) part = min(part, max(space.w, 0.0) / along);
    }
    return vec4(part * d, any ? 1.0 : 0.0);
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count || !goes_on()) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    vec3 center = center_of(chunk.x), frame = frame_of(chunk.x);
    float thickness = texelFetch(thicknesses, int(chunk.x)).x;
    double sums[kGuardSums];
    for (uint k = 0u; k < kGuardSums; ++k) sums[k] = 0.0LF;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 end = end_positions[n];
        if (!(end.w > 0.0)) continue;
        vec3 from = texelFetch(positions, int(n)).xyz, wanted = end.xyz;
        vec4 placed = place(from, wanted, thickness, frame);
        if (placed.w == 0.0) continue;
        end.xyz = from + frame + placed.xyz;
        end_positions[n] = end;
        add_held_back(wanted, end, center, sums);
    }
    put_guard_sums(c, sums);
}
