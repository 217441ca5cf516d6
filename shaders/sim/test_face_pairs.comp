// Face against face (paper 2.4): sets the bits of both faces in the Face Collision Result where they touch.
// CPU twin: gelatin::cpu::Collision. Parity: tests/gpu/collision_test.cpp.
#include "include/pairs.glsl"
#include "include/face_collisions.glsl"
#include "include/triangle_overlap.glsl"
#include "layouts/face.glsl"
layout(local_size_x = 64) in;

layout(binding = 0) uniform samplerBuffer positions;  // xyz [m]
layout(std430, binding = 3) readonly buffer Faces { Face faces[]; };
layout(std430, binding = 7) readonly buffer FacePairs { FacePair face_pairs[]; };
uniform uint face_pair_capacity;

vec3 position(uint node) { return texelFetch(positions, int(node)).xyz; }

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
    if (!triangles_overlap(position(a.a), position(a.b), position(a.c), position(b.a), position(b.b), position(b.c))) {
        return;
    }
    set_colliding(face_pair.pair, face_pair.face);
    set_colliding(find_pair(b.object, a.object), face_pair.other_face);
}
