// The plane in which two objects touch. It moves with the common velocity of their patches, or with the mean velocity of the
// pinned corners. CPU twin: src/cpu/collision/contact.h.
#include "layouts/contact.glsl"
#ifdef WRITES_CONTACT_PATCHES
layout(std430) buffer ContactPatches { ContactPatch contact_patches[]; };
#else
layout(std430) readonly buffer ContactPatches { ContactPatch contact_patches[]; };
#endif

struct ContactPlane {
    vec3 normal;    // unit, from the pair's object to the other
    vec3 velocity;  // [m/s]
    bool pinned;
};

vec3 direction(vec3 v, vec3 otherwise) {
    float length_ = length(v);
    return length_ > 0.0 ? v / length_ : otherwise;
}

ContactPlane contact_plane(uint p, uint mirror) {
    ObjectPair pair = object_pairs[p];
    ContactPatch patch_ = contact_patches[p];
    ContactPatch other = contact_patches[mirror];
    BoundingBox box = bounding_boxes[pair.object];
    BoundingBox other_box = bounding_boxes[pair.other];
    vec3 between = 0.5 * (other_box.min.xyz + other_box.max.xyz) - 0.5 * (box.min.xyz + box.max.xyz);
    vec3 middle = direction(between, vec3(0.0, 1.0, 0.0));

    ContactPlane plane;
    plane.normal = direction(patch_.area_normal.xyz - other.area_normal.xyz, middle);
    float pinned = patch_.momentum.w + other.momentum.w;
    float mass = patch_.area_normal.w + other.area_normal.w;
    plane.pinned = pinned > 0.0;
    plane.velocity = vec3(0.0);
    if (plane.pinned) {
        plane.velocity = (patch_.held.xyz + other.held.xyz) / pinned;
    } else if (mass > 0.0) {
        plane.velocity = (patch_.momentum.xyz + other.momentum.xyz) / mass;
    }
    return plane;
}
