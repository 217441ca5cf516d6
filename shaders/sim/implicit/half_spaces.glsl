// Half spaces that a node keeps to: of its displacement d in the frame, n . d <= w. CPU twin: gelatin::cpu::Guard.
// PAIRS: those of pairs, too; a list.
#include "layouts/contact_tuning.glsl"
#include "layouts/packing.glsl"
#include "sim/collision/colliders.glsl"

struct Guarded {
    vec3 from;
    vec3 to;          // where it is wanted
    vec3 frame;       // what its island has in common [m]
    float thickness;  // of its object [m]
};

#ifdef PAIRS
layout(std430) readonly buffer HalfSpaces { vec4 half_spaces[]; };  // four a pair, one for each of its nodes
layout(std430) buffer ClipLinks { uint clip_links[]; };             // to the next half space of the node, or kNone
vec4 half_space(uint clip) { return half_spaces[clip]; }
uint next_clip(uint clip) { return clip_links[clip]; }
#else
vec4 half_space(uint clip) { return vec4(0.0); }
uint next_clip(uint clip) { return kNone; }
#endif

// No island as a whole goes into a plane, nor by what keeps it out of one into another.
vec3 outside_planes(vec3 frame) {
    for (uint p = 0u; p < collider_ends.x; ++p) {
        vec3 normal = collider_center(p).xyz;
        frame -= min(dot(normal, frame), 0.0) * normal;
    }
    for (uint p = 0u; p < collider_ends.x; ++p)
        if (dot(collider_center(p).xyz, frame) < -1e-6 * length(frame)) return vec3(0.0);
    return frame;
}

// @param is_near output: whether a node comes too near where it is wanted
// Of what is no plane, and not near, w is infinite. Planes count, as what keeps a node out of one may push it into another.
vec4 beside_collider(uint p, Guarded node, out bool is_near) {
    vec4 start = distance_to_collider(p, node.from);
    float least = min(min(kLeastOfReach * node.thickness, kLeastOfGap * start.w), start.w);
    is_near = !(distance_to_collider(p, node.to).w >= least);  // also where a solve has failed
    if (!is_near && p >= collider_ends.x) return vec4(0.0, 0.0, 0.0, 1e30);
    return vec4(-start.xyz, start.w - least + dot(start.xyz, node.frame));
}

// @return whether d was outside
bool project(vec4 space, float tiny, inout vec3 d) {
    float over = dot(space.xyz, d) - space.w;
    if (!(over > tiny)) return false;
    d -= over * space.xyz;
    return true;
}

// What is left of d, at most.
float part_inside(vec4 space, vec3 d) {
    float along = dot(space.xyz, d);
    return along > space.w ? max(space.w, 0.0) / along : 1.0;
}

// Pairs first; of colliders the last first. @param first of the list, or kNone
// @return what the half spaces leave of the displacement in the frame; w: whether there are any
vec4 place(Guarded node, uint first) {
    vec3 d = node.to - node.from - node.frame;
    float tiny = 1e-6 * length(d), part = 1.0;
    bool any = first != kNone, is_outside = true, is_near;
    for (uint p = 0u; p < collider_ends.w && !any; ++p) {
        beside_collider(p, node, is_near);
        any = is_near;
    }
    if (!any) return vec4(d, 0.0);
    for (uint projection = 0u; projection < kMostRounds && is_outside; ++projection) {
        is_outside = false;
        for (uint clip = first; clip != kNone; clip = next_clip(clip))
            if (project(half_space(clip), tiny, d)) is_outside = true;
        for (uint p = collider_ends.w; p-- > 0u;) {
            if (project(beside_collider(p, node, is_near), tiny, d)) is_outside = true;
        }
    }
    for (uint clip = first; clip != kNone; clip = next_clip(clip)) part = min(part, part_inside(half_space(clip), d));
    for (uint p = 0u; p < collider_ends.w; ++p) part = min(part, part_inside(beside_collider(p, node, is_near), d));
    return vec4(part * d, 1.0);
}
