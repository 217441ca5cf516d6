// Bodies and colliders.
#include "include/tone.glsl"

layout(location = 0) out vec4 pixel;

#ifdef LIGHT_AT_NODES
in vec3 light;

void main() { pixel = body_pixel(to_display(light)); }
#else
#include "include/light.glsl"

in vec3 position;
in vec3 normal;
flat in vec3 albedo;

void main() { pixel = body_pixel(to_display(light_surface(position, normalize(normal), albedo))); }
#endif
