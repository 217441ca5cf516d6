// The faces that are marked; all others collapse to nothing.
#include "include/surface_fetch.glsl"

layout(binding = 3) uniform usamplerBuffer triangles;   // surface vertices of each face
layout(binding = 6) uniform usamplerBuffer face_marks;  // 1: marked
uniform mat4 world_to_clip;

out vec3 corner;  // barycentric

void main() {
    int face = gl_VertexID / 3, k = gl_VertexID % 3;
    uvec3 vertices = texelFetch(triangles, face).xyz;
    uint vertex = k == 0 ? vertices.x : k == 1 ? vertices.y : vertices.z;
    bool is_marked = texelFetch(face_marks, face).x != 0u;
    gl_Position = is_marked ? world_to_clip * vec4(fetch_point(int(vertex)).position, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
    corner = vec3(k == 0, k == 1, k == 2);
}
