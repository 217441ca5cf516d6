// Puts nodes where half spaces of colliders and of clipped pairs let them go. In the first round these are all nodes that come too
// near a collider, then those of pairs that have failed in the round before.
// CPU twin: gelatin::cpu::Guard::place. Parity: tests/gpu/implicit/pair_guard_test.cpp.
#define PAIRS
#include "sim/implicit/guarded_pairs.glsl"
#include "sim/implicit/half_spaces.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer thicknesses;  // of objects [m]
layout(std430) buffer Clips { NodeClips node_clips[]; };
layout(std430) writeonly buffer EndPositions { vec4 end_positions[]; };
layout(std430) writeonly buffer Guard { GuardState guard[]; };

// The last pair first, so that results do not depend on who was the first to write. It mostly is so already.
// @return the first
uint sort_clips(uint first) {
    uint last = first;
    while (first != kNone && clip_links[last] != kNone) {
        uint clip = clip_links[last];
        if (clip < last) {
            last = clip;
            continue;
        }
        clip_links[last] = clip_links[clip];
        uint before = kNone, after = first;
        for (; after > clip; after = clip_links[after]) before = after;
        clip_links[clip] = after;
        if (before == kNone) {
            first = clip;
        } else {
            clip_links[before] = clip;
        }
    }
    return first;
}

void main() {
    uint n = global_index();
    if (n >= node_count || is_held(n)) return;
    NodeClips own = node_clips[n];
    if (round_ > 0u && (own.rounds >> round_ & 1u) == 0u) return;
    uint object = object_of(n);
    vec4 to = texelFetch(wanted, int(n));
    Guarded node = Guarded(start_of(n), to.xyz, frame_of(object), texelFetch(thicknesses, int(object)).x);
    vec3 d = vec3(0.0);
    if ((own.rounds & kStays) == 0u) {
        uint first = sort_clips(own.first);
        node_clips[n].first = first;
        vec4 placed = place(node, first);
        if (placed.w == 0.0) return;
        d = placed.xyz;
    }
    end_positions[n] = vec4(node.from + node.frame + d, to.w);
    guard[0].is_changed = 1u;
}
