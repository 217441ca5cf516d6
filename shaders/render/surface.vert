// Bodies and colliders, straight from their buffers. CUT: by the plane of an overlay.
#include "render/include/surface_fetch.glsl"
#ifdef CUT
#include "render/include/cut.glsl"
#endif

uniform samplerBuffer object_colors;  // linear RGB
uniform mat4 world_to_clip;

out vec3 position;
out vec3 normal;
flat out vec3 albedo;

void main() {
    SurfacePoint point = fetch_point(gl_VertexID);
    gl_Position = world_to_clip * vec4(point.position, 1.0);
#ifdef CUT
    gl_ClipDistance[0] = depth_below_cut(point.position);
#endif
    position = point.position;
    normal = fetch_normal(gl_VertexID);
    albedo = texelFetch(object_colors, int(point.object)).rgb;
}
