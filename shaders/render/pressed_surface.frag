// Where contacts press bodies, in the colours of their pressure: such places are between bodies, so they shine through what
// hides them.
#include "render/include/color_map.glsl"

in vec3 normal;
in float value;
layout(location = 0) out vec4 pixel;

const float kOpacity = 0.8, kShown = 0.05;  // from this part of the full value on

void main() {
    pixel = vec4(color_of(value), kOpacity * clamp(value / (kShown * value_full), 0.0, 1.0));
}
