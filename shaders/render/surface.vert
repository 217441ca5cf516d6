// Bodies and colliders, directly from their buffers. CUT: by the plane of an overlay. TEXTURED: with texture coordinates instead
// of a colour.
#include "render/include/surface_fetch.glsl"
#ifdef CUT
#include "render/include/cut.glsl"
#endif

#ifdef TEXTURED
uniform samplerBuffer vertex_uvs;
out vec2 uv;
#else
uniform samplerBuffer object_colors;  // linear RGB
flat out vec3 albedo;
#endif
uniform mat4 world_to_clip;

out vec3 position;
out vec3 normal;

void main() {
    SurfacePoint point = fetch_point(gl_VertexID);
    gl_Position = world_to_clip * vec4(point.position, 1.0);
#ifdef CUT
    gl_ClipDistance[0] = depth_below_cut(point.position);
#endif
    position = point.position;
    normal = fetch_normal(gl_VertexID);
#ifdef TEXTURED
    uv = texelFetch(vertex_uvs, gl_VertexID).xy;
#else
    albedo = texelFetch(object_colors, int(point.object)).rgb;
#endif
}
