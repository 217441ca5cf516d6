// A corner of a drawn surface, pulled by gl_VertexID straight from the simulation's buffers (RenderView).
layout(binding = 0) uniform samplerBuffer node_positions;     // xyz [m]
layout(binding = 1) uniform usamplerBuffer surface_vertices;  // SurfaceVertex: node, object, ...
layout(binding = 2) uniform samplerBuffer vertex_normals;     // unit xyz

struct SurfaceCorner {
    vec3 position;  // [m]
    uint object;
};

SurfaceCorner fetch_corner() {
    uvec4 vertex = texelFetch(surface_vertices, gl_VertexID);
    return SurfaceCorner(texelFetch(node_positions, int(vertex.x)).xyz, vertex.y);
}

vec3 fetch_normal() { return texelFetch(vertex_normals, gl_VertexID).xyz; }
