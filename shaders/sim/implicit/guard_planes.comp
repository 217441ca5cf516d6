// Nodes go no farther into colliders than they were, and keep a part of their gaps; a work group a chunk.
// CPU twins: gelatin::cpu::Guard, ImplicitStep::stop_guarded. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kSums = 8u;  // kGuardSums
#include "sim/implicit/clock.glsl"
#include "sim/implicit/half_spaces.glsl"
#include "sim/implicit/lane_sums.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/guard_sums.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer displacements;  // d, xyz [m]
uniform samplerBuffer thicknesses;    // of objects [m]
layout(std430) readonly buffer FinishSums { double finish_sums[]; };  // by chunk
layout(std430) buffer EndPositions { vec4 end_positions[]; };

shared double body_sums[4];  // mass, mass times displacement

// What a free body's nodes have in common [m].
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
    return outside_planes(vec3(dvec3(body_sums[1], body_sums[2], body_sums[3]) / body_sums[0]));
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    vec3 center = center_of(chunk.x), frame = frame_of(chunk.x);
    float thickness = texelFetch(thicknesses, int(chunk.x)).x;
    double sums[kGuardSums];
    for (uint k = 0u; k < kGuardSums; ++k) sums[k] = 0.0LF;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 end = end_positions[n];
        if (!(end.w > 0.0)) continue;
        vec3 from = texelFetch(positions, int(n)).xyz, wanted = end.xyz;
        vec4 placed = place(Guarded(from, wanted, frame, thickness), kNone);
        if (placed.w == 0.0) continue;
        end.xyz = from + frame + placed.xyz;
        end_positions[n] = end;
        add_held_back(wanted, end, center, sums);
    }
    put_guard_sums(c, sums);
}
