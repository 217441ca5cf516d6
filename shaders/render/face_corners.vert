// Faces with their corners told apart; with MARKED those that are marked, while all others collapse to nothing.
#include "render/include/cut.glsl"
#include "render/include/surface_fetch.glsl"

uniform usamplerBuffer triangles;  // surface vertices of each face
#ifdef MARKED
uniform usamplerBuffer face_marks;  // 1: marked
#endif
uniform mat4 world_to_clip;

out vec3 corner;  // barycentric

void main() {
    int face = gl_VertexID / 3, k = gl_VertexID % 3;
    uvec3 vertices = texelFetch(triangles, face).xyz;
    vec3 position = fetch_point(int(vertices[k])).position;
    gl_Position = world_to_clip * vec4(position, 1.0);
#ifdef MARKED
    if (texelFetch(face_marks, face).x == 0u) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
#endif
    gl_ClipDistance[0] = depth_below_cut(position);
    corner = vec3(k == 0, k == 1, k == 2);
}
