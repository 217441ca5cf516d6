// Bodies and colliders as the light, or the floor, sees them: depth alone.
#include "include/surface_fetch.glsl"

uniform mat4 world_to_clip;

void main() { gl_Position = world_to_clip * vec4(fetch_point(gl_VertexID).position, 1.0); }
