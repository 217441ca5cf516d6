// Bodies and colliders, lit at each pixel.
#include "render/include/light.glsl"
#include "render/include/tone.glsl"

in vec3 position;
in vec3 normal;
flat in vec3 albedo;
layout(location = 0) out vec4 pixel;

void main() { pixel = body_pixel(to_display(light_surface(position, normalize(normal), albedo, pixel_openness(1.0)))); }
