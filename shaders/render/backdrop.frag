// What is seen where there is nothing.
#include "include/backdrop.glsl"
#include "include/dither.glsl"
#include "include/tone.glsl"

layout(location = 0) out vec4 pixel;

void main() { pixel = surrounding_pixel(to_display(backdrop()) + dither()); }
