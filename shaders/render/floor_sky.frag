// How much of the sky a patch of floor sees, by the form factor of each piece of the bodies' undersides.
#include "include/disc.glsl"

layout(binding = 6) uniform sampler2D underside;  // height of the lowest surface over the floor
uniform float underside_range;                    // height of 1 [m]
uniform float sky_radius;                         // how far round a point its sky is looked for [m]
uniform vec2 patch_size;                          // [m]

in vec2 uv;
layout(location = 0) out vec4 visibility;

#ifdef FEW_TAPS
const int kTaps = 16;
#else
const int kTaps = 32;
#endif
const float kLetThrough = 0.15;  // what jelly does not hold back

// The part of the cosine-weighted hemisphere that undersides at height h and distance r cover: the sum of
// h^2 / (pi (r^2 + h^2)^2) dA over rings of equal width, a point each.
void main() {
    float ring = sky_radius / float(kTaps);
    float turn = pixel_angle();  // floor_blend.frag evens it out
    float covered = 0.0;
    for (int i = 0; i < kTaps; ++i) {
        float r = (float(i) + 0.5) * ring;
        float angle = float(i) * kGoldenAngle + turn;
        float height = textureLod(underside, uv + r * vec2(cos(angle), sin(angle)) / patch_size, 0.0).r;
        float h = max(height * underside_range, ring);
        float square = r * r + h * h;
        covered += height < 1.0 ? 2.0 * h * h * r * ring / (square * square) : 0.0;
    }
    visibility = vec4(mix(1.0, kLetThrough, min(covered, 1.0)));
}
