// Bodies with a quantity at their nodes.
#include "render/include/cut.glsl"
#include "render/include/surface_fetch.glsl"

uniform samplerBuffer node_values;
uniform mat4 world_to_clip;

out vec3 normal;
out float value;

void main() {
    vec3 position = fetch_point(gl_VertexID).position;
    gl_Position = world_to_clip * vec4(position, 1.0);
    gl_ClipDistance[0] = depth_below_cut(position);
    normal = fetch_normal(gl_VertexID);
    value = texelFetch(node_values, int(texelFetch(surface_vertices, gl_VertexID).x)).x;
}
