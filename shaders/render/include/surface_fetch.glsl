// A drawn surface, pulled straight from the simulation's buffers (RenderView).
uniform samplerBuffer node_positions;     // xyz [m]
uniform usamplerBuffer surface_vertices;  // SurfaceVertex: node, object, ...
uniform samplerBuffer vertex_normals;     // unit xyz

struct SurfacePoint {
    vec3 position;  // [m]
    uint object;
};

SurfacePoint fetch_point(int vertex) {
    uvec4 found = texelFetch(surface_vertices, vertex);
    return SurfacePoint(texelFetch(node_positions, int(found.x)).xyz, found.y);
}

vec3 fetch_normal(int vertex) { return texelFetch(vertex_normals, vertex).xyz; }
