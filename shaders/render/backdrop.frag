// The background.
#include "render/include/backdrop.glsl"
#include "render/include/dither.glsl"
#include "render/include/tone.glsl"

layout(location = 0) out vec4 pixel;

void main() { pixel = surrounding_pixel(to_display(backdrop()) + dither()); }
