// Bodies and colliders, straight from their buffers.
#include "include/surface_fetch.glsl"

layout(binding = 3) uniform samplerBuffer object_colors;  // linear RGB
uniform mat4 world_to_clip;

out vec3 position;
out vec3 normal;
flat out vec3 albedo;

void main() {
    SurfacePoint point = fetch_point(gl_VertexID);
    gl_Position = world_to_clip * vec4(point.position, 1.0);
    position = point.position;
    normal = fetch_normal(gl_VertexID);
    albedo = texelFetch(object_colors, int(point.object)).rgb;
}
