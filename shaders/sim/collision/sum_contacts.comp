// Sums over the corners of the colliding faces of each pair: one work group for each pair, a fixed order of summation. Without
// APPROACHING the ContactPatch; with it the ApproachSums of the corners that approach the other object. CPU twin:
// gelatin::cpu::respond. Parity: tests/gpu/collision/respond_test.cpp.
#include "layouts/thresholds.glsl"
#ifndef APPROACHING
#define WRITES_CONTACT_PATCHES
#endif
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_collisions.glsl"
#include "sim/collision/contact_plane.glsl"
#include "layouts/face.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;   // xyz [m], inverse mass [1/kg]
uniform samplerBuffer velocities;  // xyz [m/s]
uniform usamplerBuffer node_shares;
layout(std430) readonly buffer Faces { Face faces[]; };
#ifdef APPROACHING
layout(std430) writeonly buffer Approaches { ApproachSums approaches[]; };
#endif


shared vec4 parts[3][64];

// Adds the contribution of corner `node` of a colliding face; `share` is its mass [kg], 0 if it is pinned.
#ifdef APPROACHING
void add_corner(uint node, float share, ContactPlane plane, inout vec4 a, inout vec4 b, inout vec4 c) {
    vec3 velocity = texelFetch(velocities, int(node)).xyz;
    float approach = dot(velocity - plane.velocity, plane.normal);
    if (approach <= 0.0) return;
    a += share * vec4(velocity, 1.0);
    b.x += share * approach;
}
#else
void add_corner(uint node, float share, ContactPlane plane, inout vec4 a, inout vec4 b, inout vec4 c) {
    vec3 velocity = texelFetch(velocities, int(node)).xyz;
    float pinned = share == 0.0 ? 1.0 : 0.0;
    a.w += share;
    b += vec4(share * velocity, pinned);
    c.xyz += pinned * velocity;
}
#endif

// `touch`: its bits of the Face Collision Result.
void add_face(uint f, uint touch, ContactPlane plane, inout vec4 a, inout vec4 b, inout vec4 c) {
    Face face = faces[f];
    uvec3 nodes = uvec3(face.a, face.b, face.c);
    vec4 corners[3];
    for (int k = 0; k < 3; ++k) {
        corners[k] = texelFetch(positions, int(nodes[k]));
        float shares = float(texelFetch(node_shares, int(nodes[k])).x);
        add_corner(nodes[k], corners[k].w > 0.0 ? 1.0 / (corners[k].w * shares) : 0.0, plane, a, b, c);
    }
#ifndef APPROACHING
    float weight = touch == kEnters ? 0.5 : 0.5 * kWeightOfOthers;
    a.xyz += weight * cross(corners[1].xyz - corners[0].xyz, corners[2].xyz - corners[0].xyz);
#endif
}

void main() {
    uint p = group_index();
    if (p >= dispatches[kPairGroups].count) return;  // the whole group leaves, so no one waits at the barrier
    ObjectPair pair = object_pairs[p];
    ContactPlane plane;
#ifdef APPROACHING
    plane = contact_plane(p, find_pair(pair.other, pair.object));
#endif
    vec4 a = vec4(0.0);
    vec4 b = vec4(0.0);
    vec4 c = vec4(0.0);
    uint first_face = bounding_boxes[pair.object].first_face;
    uint words = word_count(pair.object);
    uint lane = gl_LocalInvocationID.x;
    for (uint w = lane; w < words; w += 64u) {
        uint bits = face_collisions[pair.first_word + w];
        while (bits != 0u) {
            uint place = uint(findLSB(bits)) & ~1u;
            add_face(first_face + kFacesAWord * w + place / 2u, bits >> place & 3u, plane, a, b, c);
            bits &= ~(3u << place);
        }
    }
    parts[0][lane] = a;
    parts[1][lane] = b;
    parts[2][lane] = c;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) {
        a += parts[0][l];
        b += parts[1][l];
        c += parts[2][l];
    }
#ifdef APPROACHING
    approaches[p] = ApproachSums(a, b.x, 0.0, 0.0, 0.0);
#else
    contact_patches[p] = ContactPatch(a, b, c);
#endif
}
