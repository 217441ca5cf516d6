// A calm floor with a faint grid, which goes over into the backdrop before its end.
#include "render/include/backdrop.glsl"
#include "render/include/dither.glsl"
#include "render/include/floor_color.glsl"
#ifdef SHADOWED
#include "render/include/floor_light.glsl"
#include "render/include/openness.glsl"
#endif
#include "render/include/tone.glsl"

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
    vec2 visible = vec2(1.0);
#ifdef SHADOWED
    // Of two estimates of the same: the patch knows what is hidden from the eye, the picture what stands upright.
    visible = floor_visibility(xz);
    visible.y = min(visible.y, pixel_openness(-1.0));
#endif
    vec3 color = floor_color(visible) * (1.0 - 0.05 * grid());
    pixel = surrounding_pixel(to_display(mix(color, backdrop(), floor_fade(xz))) + dither());
}
