// How much of the key light (red) and of the sky (green) reaches a patch of floor. Each pixel rotates the pattern of its
// samples; floor_blend.frag averages over the pixels.
#include "render/include/floor_key.glsl"
#include "render/include/floor_sky.glsl"

uniform vec2 patch_corner;   // [m]
uniform vec2 patch_size;     // [m]
uniform float floor_height;  // [m]

in vec2 uv;
layout(location = 0) out vec4 visibility;

void main() {
    vec2 xz = patch_corner + uv * patch_size;
    vec2 direction = pixel_direction();
    visibility = vec4(key_visibility(vec3(xz.x, floor_height, xz.y), direction),
                      sky_visibility(uv, patch_size, direction), 0.0, 1.0);
}
