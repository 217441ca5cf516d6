// How much shadows darken a floor that was drawn without them, as a factor on displayed values: once a frame in a small
// texture, so that each of the floor's many pixels needs one look-up.
#include "render/include/floor_color.glsl"
#include "render/include/floor_light.glsl"
#include "render/include/tone.glsl"

in vec2 uv;
layout(location = 0) out vec4 factor;

const float kFaintest = 0.985;  // fainter shadows are let go: wide rims that cost more time than they show

void main() {
    vec2 xz = floor_patch.xy + uv / floor_patch.zw;
    vec3 shaded = to_display(floor_color(floor_visibility(xz))) / to_display(floor_color(vec2(1.0)));
    factor = vec4(mix(shaded, vec3(1.0), floor_fade(xz)) / kFaintest, 1.0);
}
