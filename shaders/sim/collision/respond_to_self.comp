// The response to faces of one object that touch one another (docs/collision.md). Without NODES: the mean response of a face to
// those that it touches, one invocation for each face that touches any; with it: a node takes the mean of its faces' responses.
// Sums are in the order of the tree and of the node's faces: the same bits each time. CPU twins: gelatin::cpu::RespondToSelf,
// src/cpu/collision/self_contact.h. Parity: tests/gpu/collision/find_self_collisions_test.cpp.
#include "sim/collision/dispatches.glsl"
#include "include/global_index.glsl"
layout(local_size_x = 64) in;

#ifdef NODES
uniform usamplerBuffer node_face_starts;
uniform usamplerBuffer node_faces;
layout(std430) readonly buffer ContactCounts { uint contact_counts[]; };
layout(std430) readonly buffer Answers { vec4 answers[]; };  // of each face: velocity [m/s], displacement [m]
layout(std430) buffer Positions { vec4 positions[]; };       // an invocation reads and writes its own
layout(std430) buffer Velocities { vec4 velocities[]; };     // node alone

void main() {
    uint n = global_index();
    if (n >= dispatches[kSelfNodes].count) return;
    uint end = texelFetch(node_face_starts, int(n) + 1).x;
    vec3 velocity = vec3(0.0), displacement = vec3(0.0);
    float shares = 0.0;
    for (uint k = texelFetch(node_face_starts, int(n)).x; k < end; ++k) {
        uint f = texelFetch(node_faces, int(k)).x;
        if (contact_counts[f] == 0u) continue;
        velocity += answers[2u * f].xyz;
        displacement += answers[2u * f + 1u].xyz;
        shares += 1.0;
    }
    if (shares == 0.0 || positions[n].w == 0.0) return;
    positions[n].xyz += displacement / shares;
    velocities[n].xyz += velocity / shares;
}
#else
#include "sim/collision/own_tree.glsl"
#include "sim/collision/triangle_overlap.glsl"
uniform samplerBuffer positions;   // xyz [m], inverse mass [1/kg]
uniform samplerBuffer velocities;  // xyz [m/s]
uniform usamplerBuffer node_face_starts;
uniform usamplerBuffer node_faces;
uniform samplerBuffer previous_positions;  // xyz [m]
layout(std430) readonly buffer ContactCounts { uint contact_counts[]; };
layout(std430) writeonly buffer Answers { vec4 answers[]; };  // of each face: velocity [m/s], displacement [m]
layout(std430) readonly buffer SelfFaces { uint self_faces[]; };
uniform float friction;
uniform float restitution;
uniform float resting_speed;  // [m/s]

// A face as one point mass: see FaceLump in src/cpu/collision/self_contact.h.
struct Lump {
    float mass;
    vec3 velocity, displacement, center, normal;
};

uint count_colliding(uint node) {
    uint end = texelFetch(node_face_starts, int(node) + 1).x;
    uint count = 0u;
    for (uint k = texelFetch(node_face_starts, int(node)).x; k < end; ++k)
        count += uint(contact_counts[texelFetch(node_faces, int(k)).x] > 0u);
    return count;
}

vec3 position(uint node) { return texelFetch(positions, int(node)).xyz; }

Lump make_lump(uint f, uvec3 corners) {
    Lump lump = Lump(0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    for (int k = 0; k < 3; ++k) {
        int n = int(corners[k]);
        vec4 at = texelFetch(positions, n);
        lump.center += at.xyz / 3.0;
        float mass = at.w > 0.0 ? 1.0 / (at.w * float(max(count_colliding(corners[k]), 1u))) : 0.0;
        lump.mass += mass;
        lump.velocity += mass * texelFetch(velocities, n).xyz;
        lump.displacement += mass * (at.xyz - texelFetch(previous_positions, n).xyz);
    }
    if (lump.mass > 0.0) {
        lump.velocity /= lump.mass;
        lump.displacement /= lump.mass;
    } else {
        for (int k = 0; k < 3; ++k) {
            int n = int(corners[k]);
            lump.velocity += texelFetch(velocities, n).xyz / 3.0;
            lump.displacement += (texelFetch(positions, n).xyz - texelFetch(previous_positions, n).xyz) / 3.0;
        }
    }
    lump.mass /= float(max(contact_counts[f], 1u));
    vec3 a = position(corners.x);
    vec3 area = cross(position(corners.y) - a, position(corners.z) - a);
    float size = length(area);
    lump.normal = size > 0.0 ? area / size : vec3(0.0);
    return lump;
}

float mobility(float mass) { return mass > 0.0 ? 1.0 / mass : 0.0; }
float length_or_one(vec3 v) {
    float size = length(v);
    return size > 0.0 ? size : 1.0;
}

void add_answer(Lump face, Lump other, inout vec3 velocity, inout vec3 displacement) {
    vec3 normal = face.normal - other.normal;
    if (dot(normal, normal) < 1e-4) normal = other.center - face.center;  // their normals coincide
    normal /= length_or_one(normal);
    float ours = mobility(face.mass), both = ours + mobility(other.mass);
    vec3 relative = face.velocity - other.velocity;
    float approach = dot(relative, normal);
    if (!(approach > 0.0) || !(both > 0.0)) return;

    float impulse = (1.0 + (approach > resting_speed ? restitution : 0.0)) * approach / both;
    vec3 sliding = relative - approach * normal;
    float braking = min(length(sliding) / both, friction * impulse);  // Coulomb [N s]
    velocity -= ours * (impulse * normal + braking / length_or_one(sliding) * sliding);
    displacement -= ours / both * max(dot(face.displacement - other.displacement, normal), 0.0) * normal;
}

bool touch(uvec4 a, uvec4 b) {
    return triangles_overlap(position(a.x), position(a.y), position(a.z), position(b.x), position(b.y), position(b.z));
}

void main() {
    uint k = global_index();
    if (k >= dispatches[kSelfFaces].count) return;
    uint face = self_faces[k];
    OwnWalk walk = start_walk(face);
    Lump lump = make_lump(face, walk.face.xyz);
    vec3 velocity = vec3(0.0), displacement = vec3(0.0);
    while (walk.node < walk.end) {
        uvec2 leaf = next_leaf(walk);
        for (uint other = leaf.x; other < leaf.x + leaf.y; ++other) {
            if (contact_counts[other] == 0u || !is_near(walk, other)) continue;
            uvec4 corners = texelFetch(faces, int(other));
            // In the order of the test that found them.
            bool first = face < other;
            if (!touch(first ? walk.face : corners, first ? corners : walk.face)) continue;
            add_answer(lump, make_lump(other, corners.xyz), velocity, displacement);
        }
    }
    float count = float(contact_counts[face]);
    answers[2u * face] = vec4(velocity / count, 0.0);
    answers[2u * face + 1u] = vec4(displacement / count, 0.0);
}
#endif
