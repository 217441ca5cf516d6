// Normal of each face, as long as twice its area [m^2], so that sums of them weigh faces by their size.
// Parity: tests/gpu/view/update_normals_test.cpp.
#include "include/global_index.glsl"
#include "layouts/face.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;  // xyz [m]
layout(std430) readonly buffer Faces { Face faces[]; };
layout(std430) writeonly buffer FaceNormals { vec4 face_normals[]; };
uniform uint face_count;

void main() {
    uint f = global_index();
    if (f >= face_count) return;
    Face face = faces[f];
    vec3 a = texelFetch(positions, int(face.a)).xyz;
    vec3 b = texelFetch(positions, int(face.b)).xyz;
    vec3 c = texelFetch(positions, int(face.c)).xyz;
    face_normals[f] = vec4(cross(b - a, c - a), 0.0);
}
