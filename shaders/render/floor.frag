// A calm floor with a faint grid, which goes over into the backdrop before its end.
#include "include/floor_light.glsl"
#include "include/backdrop.glsl"
#include "include/tone.glsl"

uniform vec3 floor_center;   // [m]
uniform float floor_radius;  // [m]
uniform float grid_spacing;  // [m]

in vec2 xz;
layout(location = 0) out vec4 pixel;

// Coverage of the grid's lines, about 1.5 pixels wide, faded where they would crowd.
float grid() {
    vec2 at = xz / grid_spacing;
    vec2 width = fwidth(at);
    vec2 distance = abs(fract(at - 0.5) - 0.5) / width;
    vec2 line = clamp(1.5 - distance, 0.0, 1.0) * clamp(1.0 - 3.0 * width, 0.0, 1.0);
    return max(line.x, line.y);
}

void main() {
    vec2 visible = floor_visibility(xz);
    vec3 light = kKeyLight * to_key_light.y * visible.x + kSkyLight * visible.y;
    vec3 color = kFloorAlbedo * light * (1.0 - 0.10 * grid());
    // In one over the distance, which is even in the picture.
    float nearness = floor_radius / max(length(xz - floor_center.xz), 1e-6);
    float fade = 1.0 - smoothstep(1.05, 6.5, nearness);
    pixel = surrounding_pixel(to_display(mix(color, backdrop(), fade)) + dither());
}
