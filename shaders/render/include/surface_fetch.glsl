// A surface, fetched directly from the simulation's buffers (RenderView).
layout(binding = 0) uniform samplerBuffer node_positions;     // xyz [m]
layout(binding = 1) uniform usamplerBuffer surface_vertices;  // SurfaceVertex: node, object, ...
layout(binding = 2) uniform samplerBuffer vertex_normals;     // unit xyz

struct SurfacePoint {
    vec3 position;  // [m]
    uint object;
};

SurfacePoint fetch_point(int vertex) {
    uvec4 found = texelFetch(surface_vertices, vertex);
    return SurfacePoint(texelFetch(node_positions, int(found.x)).xyz, found.y);
}

vec3 fetch_normal(int vertex) { return texelFetch(vertex_normals, vertex).xyz; }
