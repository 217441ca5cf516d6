// How the corners of each pair answer: they leave the contact plane with the restitution, the impulses of the two sides
// being equal and opposite, and are slowed by friction (docs/collision.md). CPU twin: src/cpu/collision/contact.h.
// Parity: tests/gpu/collision/respond_test.cpp.
#include "sim/collision/pairs.glsl"
#include "sim/collision/contact_plane.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer Responses { ContactResponse responses[]; };
layout(std430) readonly buffer Approaches { ApproachSums approaches[]; };
uniform float friction;
uniform float restitution;
uniform float resting_speed;  // [m/s]

float mobility(float mass) { return mass > 0.0 ? 1.0 / mass : 0.0; }

void main() {
    uint p = global_index();
    if (p >= dispatches[kPairs].count) return;
    uint mirror = find_pair(object_pairs[p].other, object_pairs[p].object);
    ContactPlane plane = contact_plane(p, mirror);
    ApproachSums approach = approaches[p];
    ApproachSums other = approaches[mirror];

    float impulse = plane.pinned ? approach.impulse : min(approach.impulse, other.impulse);
    if (impulse <= 0.0) {
        responses[p] = ContactResponse(vec4(plane.normal, 0.0), vec4(plane.velocity, 0.0), vec4(0.0));
        return;
    }
    float mobilities = mobility(approach.momentum.w) + (plane.pinned ? 0.0 : mobility(other.momentum.w));
    float bounce = 1.0 + (impulse * mobilities > resting_speed ? restitution : 0.0);

    vec3 other_velocity = plane.pinned ? plane.velocity : other.momentum.xyz * mobility(other.momentum.w);
    vec3 relative = approach.momentum.xyz * mobility(approach.momentum.w) - other_velocity;
    vec3 sliding = relative - dot(relative, plane.normal) * plane.normal;
    float speed = length(sliding);
    float braking = min(speed / mobilities, friction * bounce * impulse);  // Coulomb [N s]
    vec3 slowing = speed > 0.0 ? sliding * (-braking * mobility(approach.momentum.w) / speed) : vec3(0.0);
    responses[p] = ContactResponse(vec4(plane.normal, bounce * impulse / approach.impulse),
                                   vec4(plane.velocity, 0.0), vec4(slowing, 0.0));
}
