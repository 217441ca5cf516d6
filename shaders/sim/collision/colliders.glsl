// Bodies against colliders. CPU twin: src/cpu/collision/colliders.h. Colliders are sorted by kind, with a loop for each kind in
// the scene (COLLIDER_KINDS, one bit each), because software drivers pay for code that never runs.

uniform samplerBuffer colliders;  // Collider (layouts/collider.glsl), four texels each
uniform uvec4 collider_ends;                          // behind the planes, boxes, spheres, capsules

// xyz: the direction outwards (unit); w: how far the point is outside (negative inside) [m].
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
    // Inside: outwards through the nearest side.
    if (q.x >= q.y && q.x >= q.z) return vec4(side.x, 0.0, 0.0, q.x);
    if (q.y >= q.z) return vec4(0.0, side.y, 0.0, q.y);
    return vec4(0.0, 0.0, side.z, q.z);
}

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

vec4 collider_center(uint c) { return texelFetch(colliders, int(4u * c)); }
vec3 collider_axis(uint c) { return texelFetch(colliders, int(4u * c + 1u)).xyz; }

vec4 distance_to_plane(uint c, vec3 p) {
    vec4 plane = collider_center(c);
    return vec4(plane.xyz, dot(plane.xyz, p) - plane.w);
}

vec4 distance_to_rotated_box(uint c, vec3 p) {
    vec4 orientation = texelFetch(colliders, int(4u * c + 2u));
    vec3 local = rotate(vec4(-orientation.xyz, orientation.w), p - collider_center(c).xyz);
    vec4 surface = distance_to_box(local, collider_axis(c));
    return vec4(rotate(orientation, surface.xyz), surface.w);
}

vec4 distance_to_sphere(uint c, vec3 p) {
    vec4 center = collider_center(c);
    return distance_from_center(p - center.xyz, center.w);
}

vec4 distance_to_capsule(uint c, vec3 p) {
    vec4 center = collider_center(c);
    vec3 axis = collider_axis(c);
    float along = clamp(dot(p - center.xyz, axis) / dot(axis, axis), -1.0, 1.0);
    return distance_from_center(p - center.xyz - along * axis, center.w);
}

// Of collider c, of any kind.
vec4 distance_to_collider(uint c, vec3 p) {
#if (COLLIDER_KINDS & 1) != 0
    if (c < collider_ends.x) return distance_to_plane(c, p);
#endif
#if (COLLIDER_KINDS & 2) != 0
    if (c < collider_ends.y) return distance_to_rotated_box(c, p);
#endif
#if (COLLIDER_KINDS & 4) != 0
    if (c < collider_ends.z) return distance_to_sphere(c, p);
#endif
#if (COLLIDER_KINDS & 8) != 0
    if (c < collider_ends.w) return distance_to_capsule(c, p);
#endif
    return vec4(0.0, 1.0, 0.0, 1e30);
}

// The velocity after a node has hit a surface. The normal part is reversed and scaled by the restitution. The tangential part
// is reduced by at most friction times the normal change (Coulomb). Below resting_speed there is no bounce.
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

// If a node is inside collider c, by `surface`, it moves to the surface and bounces.
void resolve_collider(uint c, vec4 surface, float resting_speed, inout vec3 position, inout vec3 velocity) {
    if (surface.w >= 0.0) return;
    vec4 properties = texelFetch(colliders, int(4u * c + 3u));  // kind, friction, restitution
    position -= surface.w * surface.xyz;
    velocity = bounce(velocity, surface.xyz, properties.y, properties.z, resting_speed);
}

void resolve_colliders(float resting_speed, inout vec3 position, inout vec3 velocity) {
    uint c = 0u;
#if (COLLIDER_KINDS & 1) != 0
    for (; c < collider_ends.x; ++c) {
        resolve_collider(c, distance_to_plane(c, position), resting_speed, position, velocity);
    }
#endif
#if (COLLIDER_KINDS & 2) != 0
    for (; c < collider_ends.y; ++c) {
        resolve_collider(c, distance_to_rotated_box(c, position), resting_speed, position, velocity);
    }
#endif
#if (COLLIDER_KINDS & 4) != 0
    for (; c < collider_ends.z; ++c) {
        resolve_collider(c, distance_to_sphere(c, position), resting_speed, position, velocity);
    }
#endif
#if (COLLIDER_KINDS & 8) != 0
    for (; c < collider_ends.w; ++c) {
        resolve_collider(c, distance_to_capsule(c, position), resting_speed, position, velocity);
    }
#endif
}

// How far a point is outside the nearest collider (negative inside) [m]; a large number if there is none.
float distance_to_colliders(vec3 p) {
    float nearest = 1e30;
    uint c = 0u;
#if (COLLIDER_KINDS & 1) != 0
    for (; c < collider_ends.x; ++c) nearest = min(nearest, distance_to_plane(c, p).w);
#endif
#if (COLLIDER_KINDS & 2) != 0
    for (; c < collider_ends.y; ++c) nearest = min(nearest, distance_to_rotated_box(c, p).w);
#endif
#if (COLLIDER_KINDS & 4) != 0
    for (; c < collider_ends.z; ++c) nearest = min(nearest, distance_to_sphere(c, p).w);
#endif
#if (COLLIDER_KINDS & 8) != 0
    for (; c < collider_ends.w; ++c) nearest = min(nearest, distance_to_capsule(c, p).w);
#endif
    return nearest;
}
