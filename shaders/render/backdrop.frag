// What is seen where there is nothing.
#include "include/backdrop.glsl"
#include "include/tone.glsl"

layout(location = 0) out vec4 pixel;

void main() { pixel = vec4(to_display(backdrop()) + dither(), 1.0); }
