// Bodies and colliders as seen from the light, or from above the floor: only depth. CUT: by the plane of an overlay.
#include "render/include/surface_fetch.glsl"
#ifdef CUT
#include "render/include/cut.glsl"
#endif

uniform mat4 world_to_clip;

void main() {
    vec3 position = fetch_point(gl_VertexID).position;
    gl_Position = world_to_clip * vec4(position, 1.0);
#ifdef CUT
    gl_ClipDistance[0] = depth_below_cut(position);
#endif
}
