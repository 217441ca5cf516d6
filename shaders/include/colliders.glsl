// Bodies against colliders. CPU twin: src/cpu/colliders.h.
#include "layouts/collider.glsl"

layout(std430, binding = 7) readonly buffer Colliders { Collider colliders[]; };
uniform uint collider_count;

const uint kPlane = 0u, kBox = 1u, kSphere = 2u;

// xyz: the way out (unit); w: how far the point is outside (negative inside) [m].
vec4 distance_from_center(vec3 from_center, float radius) {
    float length_ = length(from_center);
    return vec4(length_ > 0.0 ? from_center / length_ : vec3(0.0, 1.0, 0.0), length_ - radius);
}

vec4 distance_to_box(vec3 p, vec3 half_extents) {
    vec3 q = abs(p) - half_extents;
    vec3 side = vec3(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0, p.z < 0.0 ? -1.0 : 1.0);
    vec3 outside = max(q, vec3(0.0));
    float length_ = length(outside);
    if (length_ > 0.0) return vec4(side * outside / length_, length_);
    // Inside: out through the nearest side.
    if (q.x >= q.y && q.x >= q.z) return vec4(side.x, 0.0, 0.0, q.x);
    if (q.y >= q.z) return vec4(0.0, side.y, 0.0, q.y);
    return vec4(0.0, 0.0, side.z, q.z);
}

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

vec4 surface_distance(Collider collider, vec3 p) {
    vec3 center = collider.center.xyz;
    float radius = collider.center.w;
    if (collider.kind == kPlane) return vec4(center, dot(center, p) - radius);
    if (collider.kind == kSphere) return distance_from_center(p - center, radius);
    if (collider.kind == kBox) {
        vec4 inverse_orientation = vec4(-collider.orientation.xyz, collider.orientation.w);
        vec4 local = distance_to_box(rotate(inverse_orientation, p - center), collider.axis.xyz);
        return vec4(rotate(collider.orientation, local.xyz), local.w);
    }
    vec3 axis = collider.axis.xyz;
    float along = clamp(dot(p - center, axis) / dot(axis, axis), -1.0, 1.0);
    return distance_from_center(p - center - along * axis, radius);
}

// The velocity after a node has met a surface: the normal part is reversed and scaled by the restitution, the
// tangential part slowed by at most friction times the normal change (Coulomb). Below resting_speed no bounce.
vec3 bounce(vec3 velocity, vec3 normal, float friction, float restitution, float resting_speed) {
    float approach = -dot(velocity, normal);
    if (approach <= 0.0) return velocity;
    float rebound = approach > resting_speed ? restitution * approach : 0.0;
    vec3 tangential = velocity + approach * normal;
    float speed = length(tangential);
    float slowing = friction * (approach + rebound);
    float kept = speed > slowing ? 1.0 - slowing / speed : 0.0;
    return kept * tangential + rebound * normal;
}

// Moves a node that is inside a collider to its surface and lets it bounce.
void resolve_colliders(float resting_speed, inout vec3 position, inout vec3 velocity) {
    for (uint c = 0u; c < collider_count; ++c) {
        vec4 surface = surface_distance(colliders[c], position);
        if (surface.w >= 0.0) continue;
        position -= surface.w * surface.xyz;
        velocity = bounce(velocity, surface.xyz, colliders[c].friction, colliders[c].restitution, resting_speed);
    }
}
