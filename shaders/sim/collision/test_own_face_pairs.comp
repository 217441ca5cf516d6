// Face against face of one object: counts how many others each touches, and lists those that touch any, in no particular order.
// CPU twin: gelatin::cpu::FindSelfCollisions. Parity: tests/gpu/collision/find_self_collisions_test.cpp.
#define WRITES_DISPATCHES
#include "sim/collision/dispatches.glsl"
#include "include/global_index.glsl"
#include "sim/collision/triangle_overlap.glsl"
#include "layouts/face.glsl"
#include "layouts/object_pair.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;  // xyz [m]
uniform usamplerBuffer faces;     // Face
layout(std430) writeonly buffer SelfFaces { uint self_faces[]; };
layout(std430) buffer ContactCounts { uint contact_counts[]; };
layout(std430) readonly buffer FacePairs { FacePair face_pairs[]; };
uniform uint face_pair_capacity;
uniform uint face_count;
uniform uint node_count;

vec3 position(uint node) { return texelFetch(positions, int(node)).xyz; }

void count_contact(uint face) {
    if (atomicAdd(contact_counts[face], 1u) != 0u) return;
    uint slot = take_slot(kSelfFaces, face_count);
    self_faces[slot] = face;
    if (slot == 0u) dispatches[kSelfNodes] = dispatch_invocations(node_count);
}

void main() {
    uint k = global_index();
    if (k >= min(dispatches[kSelfPairs].count, face_pair_capacity)) return;
    FacePair face_pair = face_pairs[k];
    // In a fixed order, so that both faces get the same result.
    uvec3 a = texelFetch(faces, int(min(face_pair.face, face_pair.other_face))).xyz;
    uvec3 b = texelFetch(faces, int(max(face_pair.face, face_pair.other_face))).xyz;
    if (!triangles_overlap(position(a.x), position(a.y), position(a.z), position(b.x), position(b.y), position(b.z))) {
        return;
    }
    count_contact(face_pair.face);
    count_contact(face_pair.other_face);
}
