// Half spaces that a node keeps to: of its displacement d in the frame, n . d <= w. CPU twin: gelatin::cpu::Guard.
// PAIRS: clips[] has those of pairs, clip_count of them.
#include "layouts/contact_tuning.glsl"
#include "sim/collision/colliders.glsl"

struct Guarded {
    vec3 from;
    vec3 to;          // where it is wanted
    vec3 frame;       // what its island has in common [m]
    float thickness;  // of its object [m]
};

#ifdef PAIRS
vec4 clips[kClipsOfNode];
uint clip_count;
vec4 clip(uint k) { return clips[k]; }
#else
const uint clip_count = 0u;
vec4 clip(uint k) { return vec4(0.0, 0.0, 0.0, 1e30); }
#endif

// No island as a whole goes into a plane.
vec3 outside_planes(vec3 frame) {
    for (uint p = 0u; p < collider_ends.x; ++p) {
        vec3 normal = collider_center(p).xyz;
        frame -= min(dot(normal, frame), 0.0) * normal;
    }
    return frame;
}

// Of a collider that a node does not come too near to w is infinite.
vec4 beside_collider(uint p, Guarded node) {
    vec4 start = distance_to_collider(p, node.from);
    float least = min(min(kLeastOfReach * node.thickness, kLeastOfGap * start.w), start.w);
    if (distance_to_collider(p, node.to).w >= least) return vec4(0.0, 0.0, 0.0, 1e30);
    return vec4(-start.xyz, start.w - least + dot(start.xyz, node.frame));
}

// Pairs first; of colliders the last first.
vec4 half_space(uint k, Guarded node) {
    return k < clip_count ? clip(k) : beside_collider(clip_count + collider_ends.w - 1u - k, node);
}

// @return what the half spaces leave of the displacement in the frame; w: whether there are any
vec4 place(Guarded node) {
    vec3 d = node.to - node.from - node.frame;
    float tiny = 1e-6 * length(d), part = 1.0;
    uint count = clip_count + collider_ends.w;
    bool any = false, is_outside = true;
    for (uint projection = 0u; projection < kProjections && is_outside; ++projection) {
        is_outside = false;
        for (uint k = 0u; k < count; ++k) {
            vec4 space = half_space(k, node);
            if (space.w >= 1e30) continue;
            any = true;
            float over = dot(space.xyz, d) - space.w;
            if (!(over > tiny)) continue;
            d -= over * space.xyz;
            is_outside = true;
        }
    }
    for (uint k = 0u; any && k < count; ++k) {
        vec4 space = half_space(k, node);
        float along = dot(space.xyz, d);
        if (along > space.w) part = min(part, max(space.w, 0.0) / along);
    }
    return vec4(part * d, any ? 1.0 : 0.0);
}
