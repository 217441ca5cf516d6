// Where the guard of pairs begins: where nodes are wanted, and by chunk what they have in common; a work group a chunk.
// CPU twin: gelatin::cpu::Guard::find_frames. Parity: tests/gpu/implicit/pair_guard_test.cpp.
const uint kSums = 10u;  // of free nodes, and from kOfHeld on of held ones: weight, weight times displacement, and its square
const uint kOfHeld = 5u;
#define WRITES_DISPATCHES
#include "layouts/tries.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/implicit/guarded_pairs.glsl"
#include "sim/implicit/lane_sums.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer chunks;  // object, first, count, origin
uniform uint chunk_count;
uniform uint pair_capacity;
layout(std430) readonly buffer Counts { PairCounts counts[]; };
layout(std430) buffer EndPositions { vec4 end_positions[]; };
layout(std430) writeonly buffer Wanted { vec4 wanted_positions[]; };
layout(std430) writeonly buffer Clips { NodeClips node_clips[]; };
layout(std430) writeonly buffer FrameSums { double frame_sums[]; };  // by chunk
layout(std430) buffer Guard { GuardState guard[]; };

// Nothing is dispatched yet, but for the first round's pairs; `count` has the groups of a row for those who do.
Dispatch waiting(uint invocations) {
    Dispatch all = dispatch_invocations(invocations);
    return Dispatch(0u, all.groups_y, 1u, all.groups_x);
}

void begin() {
    guard[0] = GuardState(clock[0].guards == 0u ? 0u : guard[0].is_changed, 0u, 0u, 0u);
    Dispatch pairs = waiting(min(counts[0].pairs, pair_capacity)), nodes = waiting(node_count);
    for (uint r = 0u; r <= kGuardRounds; ++r) {
        dispatches[kGuardRound + 2u * r] = pairs;
        dispatches[kGuardRound + 2u * r + 1u] = nodes;  // the last ones are kGuardStays
    }
    dispatches[kGuardRound].groups_x = pairs.count;
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    if (c == 0u && lane == 0u) begin();
    uvec4 chunk = texelFetch(chunks, int(c));
    double sums[kSums];
    for (uint k = 0u; k < kSums; ++k) sums[k] = 0.0LF;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 end = end_positions[n];
        vec3 from = start_of(n);
        if (any(isnan(end)) || any(isinf(end))) {  // of a solve that has failed
            end.xyz = from;
            end_positions[n] = end;
        }
        wanted_positions[n] = end;
        node_clips[n] = NodeClips(0u, kNone);
        bool is_held = end.w == 0.0;
        uint first = is_held ? kOfHeld : 0u;
        double weight = is_held ? 1.0LF : 1.0LF / double(end.w);
        dvec3 moved = dvec3(end.xyz - from);
        sums[first] += weight;
        for (uint k = 0u; k < 3u; ++k) sums[first + 1u + k] += weight * moved[k];
        sums[first + 4u] += weight * dot(moved, moved);
    }
    for (uint k = 0u; k < kSums; ++k) put_sum(k, sums[k]);
    barrier();
    if (lane < kSums) frame_sums[c * kSums + lane] = sum_of_lanes(lane);
}
