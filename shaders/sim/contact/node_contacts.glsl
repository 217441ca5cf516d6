// What each node knows of its contacts until the next aim: terms of its own, and how far it may go. None of it depends on
// other nodes. CPU twin: gelatin::cpu::NodeContacts. To be included after sim/collision/colliders.glsl and
// sim/elasticity/node_terms.glsl.
#include "layouts/node_contacts.glsl"
#include "sim/contact/contact_law.glsl"

layout(std430) readonly buffer Limits { NodeLimits node_limits[]; };  // of surface nodes
layout(std430) readonly buffer Planes { vec4 node_planes[]; };        // towards the other side, unit; head [m]
layout(std430) readonly buffer Shares { NodeShare node_shares[]; };

const float kSlipShare = 0.01;  // as the CPU has it

// Of nodes inside a body: they may go anywhere.
const NodeLimits kNoLimits = NodeLimits(vec4(0.0, 0.0, 0.0, 3e38), vec4(0.0), vec4(0.0, 0.0, 0.0, 1.0), vec4(0.0), 0u, 0u, 0u, 0u);

float gap_at(NodeShare share, vec3 displacement) {
    return share.towards.w - share.law.x * dot(share.towards.xyz, displacement);
}

void add_contact_share(NodeShare share, float gap, inout NodeTerms terms) {
    terms.force -= contact_force(gap, share.law.z, share.law.y) * share.towards.xyz;
    add_outer(share.law.x * contact_hessian(gap, share.law.z, share.law.y), share.towards.xyz, terms);
}

// @param limit the most that friction may be [N], positive
void add_friction_share(NodeShare share, vec3 displacement, float limit, inout NodeTerms terms) {
    vec3 slid = displacement - dot(share.towards.xyz, displacement) * share.towards.xyz;
    vec3 hold = share.hold.xyz + share.law.y * share.law.x * slid;
    float squared = dot(hold, hold);
    float part = limit / max(sqrt(squared), limit);
    terms.force -= part * hold;
    float across = share.law.x * share.law.y * part;
    terms.diagonal += across;
    add_outer(-across, share.towards.xyz, terms);
    if (squared > limit * limit) add_outer(-(1.0 - kSlipShare) * across / squared, hold, terms);
}

// The terms of a node's contacts. Friction is less where the node presses less than at the aim.
void add_contacts(NodeLimits limits, vec3 position, inout NodeTerms terms) {
    vec3 displacement = position - limits.aimed_at.xyz;
    for (uint k = limits.first_share; k < limits.first_share + limits.share_count; ++k) {
        NodeShare share = node_shares[k];
        float gap = gap_at(share, displacement);
        add_contact_share(share, gap, terms);
        float limit = min(share.hold.w, share.law.w * contact_force(gap, share.law.z, share.law.y));
        if (limit > 0.0) add_friction_share(share, displacement, limit, terms);
    }
}

// The part of a motion from u, inside a ball round the origin, that stays in it.
float part_within(vec3 u, vec3 motion, float radius) {
    vec3 end = u + motion;
    if (dot(end, end) <= radius * radius) return 1.0;
    float a = dot(motion, motion), b = dot(u, motion), c = dot(u, u) - radius * radius;
    if (!(c < 0.0) || !(a > 0.0)) return 0.0;
    float root = sqrt(b * b - a * c);
    float part = b > 0.0 ? -c / (b + root) : (root - b) / a;
    return clamp(0.999 * part, 0.0, 1.0);
}

float beside_way(vec3 way, vec3 moved) {
    float squared = dot(way, way);
    float along = squared > 0.0 ? clamp(dot(moved, way) / squared, 0.0, 1.0) : 0.0;
    return length(moved - along * way);
}

// A room is convex: what leaves it does so once.
float part_within_room(NodeLimits limits, vec3 moved, vec3 motion) {
    vec3 way = limits.way.xyz;
    float radius = limits.room.w;
    if (way == vec3(0.0)) return part_within(moved, motion, radius);
    if (beside_way(way, moved + motion) <= radius) return 1.0;
    if (!(beside_way(way, moved) < radius)) return 0.0;
    float low = 0.0, high = 1.0;
    for (int i = 0; i < 10; ++i) {
        float middle = 0.5 * (low + high);
        if (beside_way(way, moved + middle * motion) < radius) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

float head_left(vec4 plane, vec3 displacement) { return max(plane.w - dot(plane.xyz, displacement), 0.0); }

// Along the planes in its way, the nearest two of which it is projected on; then it is shortened.
vec3 kept_to_planes(NodeLimits limits, vec3 displacement, vec3 motion) {
    uint first = limits.first_plane, end = first + limits.plane_count;
    for (int pass = 0; pass < 2; ++pass) {
        float farthest = 0.0;
        vec3 worst = vec3(0.0);
        for (uint k = first; k < end; ++k) {
            vec4 plane = node_planes[k];
            float beyond = dot(plane.xyz, motion) - head_left(plane, displacement);
            if (beyond > farthest) {
                farthest = beyond;
                worst = plane.xyz;
            }
        }
        if (farthest == 0.0) return motion;
        motion -= farthest * worst;
    }
    float part = 1.0;
    for (uint k = first; k < end; ++k) {
        vec4 plane = node_planes[k];
        float along = dot(plane.xyz, motion), head = head_left(plane, displacement);
        if (!(along <= head)) part = along > 0.0 ? min(part, head / along) : 0.0;
    }
    return part * motion;
}

#if (COLLIDER_KINDS & 1) != 0
// The part of a motion that takes a node no deeper into any plane than it is, or to the surface.
float part_outside_planes(vec3 position, vec3 motion) {
    float part = 1.0;
    for (uint c = 0u; c < collider_ends.x; ++c) {
        vec4 surface = distance_to_plane(c, position);
        float approach = -dot(surface.xyz, motion);
        if (approach > 0.0) part = min(part, max(surface.w, 0.0) / approach);
    }
    return part;
}
#endif

// Of the objective along a motion, by its part: the slope, and its change.
vec2 slope_along(NodeLimits limits, vec3 displacement, vec3 motion, float pull, float curvature, float part) {
    vec2 slope = vec2(part * curvature - pull, curvature);
    for (uint k = limits.first_share; k < limits.first_share + limits.share_count; ++k) {
        NodeShare share = node_shares[k];
        float along = dot(share.towards.xyz, motion);
        float gap = gap_at(share, displacement) - part * share.law.x * along;
        slope.x += contact_force(gap, share.law.z, share.law.y) * along;
        slope.y += share.law.x * contact_hessian(gap, share.law.z, share.law.y) * along * along;
    }
    return slope;
}

// The part of a motion at which the node's objective is least, with contacts as they are and the rest to second order. A
// node just outside the reach feels nothing, and Newton's step would throw it onto a plane.
float least_along(NodeLimits limits, vec3 displacement, vec3 motion, NodeTerms all) {
    vec3 stretched = all.diagonal * motion + all.beside.zxy * motion.yzx + all.beside.yzx * motion.zxy;
    float pull = dot(all.force, motion), curvature = dot(stretched, motion);
    for (uint k = limits.first_share; k < limits.first_share + limits.share_count; ++k) {  // what is left without contacts
        NodeShare share = node_shares[k];
        float along = dot(share.towards.xyz, motion), gap = gap_at(share, displacement);
        pull += contact_force(gap, share.law.z, share.law.y) * along;
        curvature -= share.law.x * contact_hessian(gap, share.law.z, share.law.y) * along * along;
    }
    vec2 slope = slope_along(limits, displacement, motion, pull, curvature, 1.0);
    if (!(slope.x > 0.0)) return 1.0;
    float low = 0.0, high = 1.0, part = 0.5;
    for (int i = 0; i < 6; ++i) {
        slope = slope_along(limits, displacement, motion, pull, curvature, part);
        if (slope.x > 0.0) {
            high = part;
        } else {
            low = part;
        }
        float next = part - slope.x / slope.y;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        bool is_near = abs(next - part) < 0.02;
        part = next;
        if (is_near) break;
    }
    return part;
}

// Where a node may go that is at `from` and would go to `to`: as far as its planes and its room allow, and to where its part
// of the objective is least on the way. @param all its terms at `from`, those of contacts among them
vec3 limited(NodeLimits limits, vec3 from, vec3 to, NodeTerms all) {
    vec3 ahead = to - limits.aimed_at.xyz;
    if (dot(ahead, ahead) <= limits.aimed_at.w) return to;
    if (limits.way.w == 0.0) return from;
    vec3 displacement = from - limits.aimed_at.xyz;
    vec3 motion = kept_to_planes(limits, displacement, to - from);
    motion *= part_within_room(limits, from - limits.room.xyz, motion);
    motion *= part_within(from - limits.own_room.xyz, motion, limits.own_room.w);
#if (COLLIDER_KINDS & 1) != 0
    motion *= part_outside_planes(from, motion);
#endif
    if (limits.share_count > 0u) motion *= least_along(limits, displacement, motion, all);
    return from + motion;
}
