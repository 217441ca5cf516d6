// Bodies and colliders, lit at each pixel. TEXTURED: in the colours of a texture.
#include "render/include/light.glsl"
#include "render/include/tone.glsl"

in vec3 position;
in vec3 normal;
#ifdef TEXTURED
uniform sampler2D albedo_texture;  // linear RGB
in vec2 uv;
#else
flat in vec3 albedo;
#endif
layout(location = 0) out vec4 pixel;

void main() {
#ifdef TEXTURED
    vec3 albedo = texture(albedo_texture, uv).rgb;
#endif
    pixel = body_pixel(to_display(light_surface(position, normalize(normal), albedo, pixel_openness(1.0))));
}
