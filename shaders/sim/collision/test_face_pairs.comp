// Face against face (paper 2.4): records in the Face Collision Result how both faces touch; with CONTINUOUS at any time of the
// step, each node moving along a straight line. CPU twin: gelatin::cpu::Collision. Parity:
// tests/gpu/collision/collision_test.cpp.
#define WRITES_FACE_COLLISIONS
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_collisions.glsl"
#include "sim/collision/rounding.glsl"
#ifdef CONTINUOUS
#include "sim/collision/face_contact.glsl"
#else
#include "sim/collision/triangle_overlap.glsl"
#endif
#include "layouts/face.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;           // xyz [m]
uniform samplerBuffer previous_positions;  // at the start of the step, xyz [m]
layout(std430) readonly buffer Faces { Face faces[]; };
layout(std430) readonly buffer FacePairs { FacePair face_pairs[]; };
uniform uint face_pair_capacity;

mat3 corners(Face face, samplerBuffer at) {
    return mat3(texelFetch(at, int(face.a)).xyz, texelFetch(at, int(face.b)).xyz, texelFetch(at, int(face.c)).xyz);
}

// How each touches the other; 0 if they do not.
uvec2 test(Face a, Face b) {
#ifdef CONTINUOUS
    MovingFace face = MovingFace(corners(a, previous_positions), corners(a, positions));
    MovingFace other = MovingFace(corners(b, previous_positions), corners(b, positions));
    return time_of_impact(face, other) != kNever ? face_contacts(face, other) : uvec2(0u);
#else
    mat3 s = corners(a, positions), t = corners(b, positions);
    return triangles_overlap(s[0], s[1], s[2], t[0], t[1], t[2]) ? uvec2(kEnters) : uvec2(0u);
#endif
}

void set_touch(uint p, uint face, uint touch) {
    ObjectPair pair = object_pairs[p];
    uint index = face - bounding_boxes[pair.object].first_face;
    atomicOr(face_collisions[pair.first_word + index / kFacesAWord], touch << (2u * (index % kFacesAWord)));
}

void main() {
    uint k = global_index();
    if (k >= min(dispatches[kFacePairs].count, face_pair_capacity)) return;
    FacePair face_pair = face_pairs[k];
    Face a = faces[face_pair.face];
    Face b = faces[face_pair.other_face];
    uvec2 touches = test(a, b);
    if (touches.x == 0u) return;
    set_touch(face_pair.pair, face_pair.face, touches.x);
    set_touch(find_pair(b.object, a.object), face_pair.other_face, touches.y);
}
