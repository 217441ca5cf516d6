// What the free nodes of an island have in common: their mean displacement; a work group an object. Islands of which something is
// held have nothing in common. CPU twin: gelatin::cpu::Guard::find_frames. Parity: tests/gpu/implicit/pair_guard_test.cpp.
const uint kSums = 5u;
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
    double sums[kSums] = double[](0.0LF, 0.0LF, 0.0LF, 0.0LF, 0.0LF);
    for (uint c = lane; c < chunk_count; c += 64u) {
        if (island_of(texelFetch(chunks, int(c)).x) != island_of(o)) continue;
        for (uint k = 0u; k < kSums; ++k) sums[k] += frame_sums[c * kSums + k];
    }
    for (uint k = 0u; k < kSums; ++k) put_sum(k, sums[k]);
    barrier();
    if (lane != 0u) return;
    double mass = sum_of_lanes(0u), held = sum_of_lanes(4u);
    vec3 frame = vec3(0.0);
    if (mass > 0.0LF && held == 0.0LF)
        frame = outside_planes(vec3(dvec3(sum_of_lanes(1u), sum_of_lanes(2u), sum_of_lanes(3u)) / mass));
    object_frames[o] = vec4(frame, 0.0);
    object_marks[o] = 0u;
}
