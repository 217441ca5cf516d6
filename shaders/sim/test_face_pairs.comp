// Face against face (paper 2.4): sets the bits of both faces in the Face Collision Result where they touch; with CONTINUOUS
// at any time of the step, each node moving straight.
// CPU twin: gelatin::cpu::Collision. Parity: tests/gpu/collision_test.cpp.
#include "include/pairs.glsl"
#include "include/face_collisions.glsl"
#ifdef CONTINUOUS
#include "include/time_of_impact.glsl"
#else
#include "include/triangle_overlap.glsl"
#endif
#include "layouts/face.glsl"
layout(local_size_x = 64) in;

layout(binding = 0) uniform samplerBuffer positions;           // xyz [m]
layout(binding = 1) uniform samplerBuffer previous_positions;  // at the start of the step, xyz [m]
layout(std430, binding = 3) readonly buffer Faces { Face faces[]; };
layout(std430, binding = 7) readonly buffer FacePairs { FacePair face_pairs[]; };
uniform uint face_pair_capacity;

mat3 corners(Face face, samplerBuffer at) {
    return mat3(texelFetch(at, int(face.a)).xyz, texelFetch(at, int(face.b)).xyz, texelFetch(at, int(face.c)).xyz);
}

bool touch(Face a, Face b) {
#ifdef CONTINUOUS
    return time_of_impact(MovingFace(corners(a, previous_positions), corners(a, positions)),
                          MovingFace(corners(b, previous_positions), corners(b, positions))) != kNever;
#else
    mat3 s = corners(a, positions), t = corners(b, positions);
    return triangles_overlap(s[0], s[1], s[2], t[0], t[1], t[2]);
#endif
}

void set_colliding(uint p, uint face) {
    ObjectPair pair = object_pairs[p];
    uint index = face - bounding_boxes[pair.object].first_face;
    atomicOr(face_collisions[pair.first_word + index / 32u], 1u << (index % 32u));
}

void main() {
    uint k = global_index();
    if (k >= min(dispatches[kFacePairs].count, face_pair_capacity)) return;
    FacePair face_pair = face_pairs[k];
    Face a = faces[face_pair.face];
    Face b = faces[face_pair.other_face];
    if (!touch(a, b)) return;
    set_colliding(face_pair.pair, face_pair.face);
    set_colliding(find_pair(b.object, a.object), face_pair.other_face);
}
