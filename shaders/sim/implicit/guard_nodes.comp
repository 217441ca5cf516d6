// Puts nodes where half spaces of colliders and of clipped pairs let them go. In the first round these are all nodes that come too
// near a collider, then those of pairs that have failed in the round before.
// CPU twin: gelatin::cpu::Guard::place. Parity: tests/gpu/implicit/pair_guard_test.cpp.
#define PAIRS
#include "sim/implicit/guarded_pairs.glsl"
#include "sim/implicit/half_spaces.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer thicknesses;  // of objects [m]
layout(std430) readonly buffer Clips { NodeClips node_clips[]; };
layout(std430) readonly buffer ClipLists { uint clip_lists[]; };    // pairs, kClipsOfNode a node
layout(std430) readonly buffer PairClips { vec4 pair_clips[]; };    // by pair
layout(std430) writeonly buffer EndPositions { vec4 end_positions[]; };
layout(std430) writeonly buffer Guard { GuardState guard[]; };

// The half space of a clipped pair for one of its nodes.
vec4 clip_of(uint p, uint n) {
    GuardedPair pair = fetch_pair(p);
    vec4 limits = pair_clips[p];
    float height = dot(pair.normal, start_of(n) - start_of(pair.nodes.x));
    bool is_on_first = n == pair.nodes.x || (pair.is_edges && n == pair.nodes.y);
    return is_on_first ? vec4(pair.normal, limits.x - height + limits.z) : vec4(-pair.normal, height - limits.y + limits.w);
}

// The last pair first, so that results do not depend on who was the first to write.
void find_clips(uint n, uint count) {
    uint pairs[kClipsOfNode];
    for (uint k = 0u; k < count; ++k) {
        uint pair = clip_lists[n * kClipsOfNode + k], place = k;
        for (; place > 0u && pairs[place - 1u] < pair; --place) pairs[place] = pairs[place - 1u];
        pairs[place] = pair;
    }
    for (uint k = 0u; k < count; ++k) clips[k] = clip_of(pairs[k], n);
    clip_count = count;
}

void main() {
    uint n = global_index();
    if (n >= node_count || !goes_on() || is_held(n)) return;
    NodeClips own = node_clips[n];
    if (round_ > 0u && (own.rounds >> round_ & 1u) == 0u) return;
    uint object = object_of(n);
    vec4 to = texelFetch(wanted, int(n));
    Guarded node = Guarded(start_of(n), to.xyz, frame_of(object), texelFetch(thicknesses, int(object)).x);
    vec3 d = vec3(0.0);
    if ((own.rounds & kStays) == 0u && own.count <= kClipsOfNode) {
        find_clips(n, own.count);
        vec4 placed = place(node);
        if (placed.w == 0.0) return;
        d = placed.xyz;
    }
    end_positions[n] = vec4(node.from + node.frame + d, to.w);
    guard[0].is_changed = 1u;
}
