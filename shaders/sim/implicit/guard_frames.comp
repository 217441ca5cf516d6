// What the free nodes of an island have in common: their mean displacement; a work group an object. Islands of which something is
// held go as that does, if it all goes the same way.
// CPU twin: gelatin::cpu::Guard::find_frames. Parity: tests/gpu/implicit/pair_guard_test.cpp.
const uint kSums = 10u;  // as guard_begin.comp has them
const uint kOfHeld = 5u;
#include "sim/implicit/guarded_pairs.glsl"
#include "sim/implicit/half_spaces.glsl"
#include "sim/implicit/lane_sums.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer chunks;  // object, first, count, origin
uniform uint chunk_count;
uniform uint object_count;
layout(std430) readonly buffer FrameSums { double frame_sums[]; };  // by chunk
layout(std430) writeonly buffer Frames { vec4 object_frames[]; };
layout(std430) writeonly buffer Marks { uint object_marks[]; };     // kIsBlocked and so on

void main() {
    uint o = group_index(), lane = gl_LocalInvocationID.x;
    if (o >= object_count) return;
    double sums[kSums];
    for (uint k = 0u; k < kSums; ++k) sums[k] = 0.0LF;
    for (uint c = lane; c < chunk_count; c += 64u) {
        if (island_of(texelFetch(chunks, int(c)).x) != island_of(o)) continue;
        for (uint k = 0u; k < kSums; ++k) sums[k] += frame_sums[c * kSums + k];
    }
    for (uint k = 0u; k < kSums; ++k) put_sum(k, sums[k]);
    barrier();
    if (lane != 0u) return;
    bool is_held = sum_of_lanes(kOfHeld) > 0.0LF;
    uint first = is_held ? kOfHeld : 0u;
    double weight = sum_of_lanes(first);
    dvec3 mean = dvec3(sum_of_lanes(first + 1u), sum_of_lanes(first + 2u), sum_of_lanes(first + 3u)) / max(weight, 1e-300LF);
    bool is_same = sum_of_lanes(kOfHeld + 4u) <= (1.0LF + double(kHardly) * double(kHardly)) * weight * dot(mean, mean);
    object_frames[o] = vec4(!is_held || is_same ? outside_planes(vec3(mean)) : vec3(0.0), 0.0);
    object_marks[o] = 0u;
}
