// Bodies and colliders, straight from their buffers. LIGHT_AT_NODES: the paper's light, at each node.
#include "include/surface_fetch.glsl"
#ifdef LIGHT_AT_NODES
#include "include/light.glsl"
#endif

layout(binding = 3) uniform samplerBuffer object_colors;  // linear RGB
uniform mat4 world_to_clip;

#ifdef LIGHT_AT_NODES
out vec3 light;
#else
out vec3 position;
out vec3 normal;
flat out vec3 albedo;
#endif

void main() {
    SurfaceCorner corner = fetch_corner();
    vec3 color = texelFetch(object_colors, int(corner.object)).rgb;
    gl_Position = world_to_clip * vec4(corner.position, 1.0);
#ifdef LIGHT_AT_NODES
    light = light_surface(corner.position, fetch_normal(), color);
#else
    position = corner.position;
    normal = fetch_normal();
    albedo = color;
#endif
}
