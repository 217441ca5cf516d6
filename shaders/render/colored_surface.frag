// Bodies in the colours of a quantity, shaded so lightly that they can be compared with the legend's colours.
#include "render/include/color_map.glsl"
#include "render/include/studio.glsl"
#include "render/include/tone.glsl"

in vec3 normal;
in float value;
layout(location = 0) out vec4 pixel;

const float kDarkest = 0.62;

void main() {
    float facing = 0.5 + 0.5 * dot(normalize(normal), to_key_light);
    pixel = body_pixel(color_of(value) * mix(kDarkest, 1.0, facing));
}
