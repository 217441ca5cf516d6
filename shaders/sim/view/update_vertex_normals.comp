// Unit normal of each surface vertex: the area-weighted mean of its faces', which lie on one side of a crease.
// Where the faces cancel out it points up rather than being NaN. Parity: tests/gpu/view/update_normals_test.cpp.
#include "include/global_index.glsl"
#include "layouts/surface_vertex.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer face_normals;   // [m^2]
uniform usamplerBuffer vertex_faces;  // SurfaceVertex's lists
layout(std430) readonly buffer SurfaceVertices { SurfaceVertex surface_vertices[]; };
layout(std430) writeonly buffer VertexNormals { vec4 vertex_normals[]; };
uniform uint vertex_count;

void main() {
    uint v = global_index();
    if (v >= vertex_count) return;
    SurfaceVertex vertex = surface_vertices[v];
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < vertex.face_count; ++k) {
        uint face = texelFetch(vertex_faces, int(vertex.first_face + k)).x;
        sum += texelFetch(face_normals, int(face)).xyz;
    }
    float length_ = length(sum);
    vertex_normals[v] = vec4(length_ > 0.0 ? sum / length_ : vec3(0.0, 1.0, 0.0), 0.0);
}
