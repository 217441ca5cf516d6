// How two faces that touch within a step do so, each as it sees the other. CPU twin: src/cpu/collision/face_contact.h.
#include "layouts/thresholds.glsl"
#include "sim/collision/time_of_impact.glsl"


vec3 unit_normal(mat3 corners) {
    vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    float size = length(normal);
    return size > 0.0 ? normal / size : vec3(0.0);
}

uvec2 face_contacts(MovingFace face, MovingFace other) {
    vec3 normal = unit_normal(face.start), other_normal = unit_normal(other.start);
    if (abs(dot(normal, other_normal)) < kAcross) return uvec2(kTouches);
    mat3 apart = (face.end - face.start) - (other.end - other.start);
    vec3 relative = apart[0] + apart[1] + apart[2];  // three times the face's displacement, as seen from the other
    return uvec2(dot(relative, normal) > 0.0 ? kEnters : kTouches,
                 dot(relative, other_normal) < 0.0 ? kEnters : kTouches);
}
