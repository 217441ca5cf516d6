// How much of the sky a patch of floor sees, by the form factor of each piece of the bodies' undersides.
#include "render/include/disc.glsl"

uniform sampler2D underside;  // height of the lowest surface over the floor
uniform float underside_range;                    // height of 1 [m]
uniform float sky_radius;                         // how far round a point its sky is searched for [m]

#ifdef FEW_TAPS
const int kSkyTaps = 16;
#else
const int kSkyTaps = 32;
#endif
const float kLetThrough = 0.15;  // what jelly does not hold back

// The part of the cosine-weighted hemisphere that undersides at height h and distance r cover: the sum of h^2 / (pi (r^2 +
// h^2)^2) dA over rings of equal width, one sample each.
// @param uv of the point in the patch of floor, patch_size its size [m]
// @param direction random, unit length
float sky_visibility(vec2 uv, vec2 patch_size, vec2 direction) {
    float ring = sky_radius / float(kSkyTaps);
    float covered = 0.0;
    for (int i = 0; i < kSkyTaps; ++i) {
        float r = (float(i) + 0.5) * ring;
        float height = textureLod(underside, uv + r * direction / patch_size, 0.0).r;
        float h = max(height * underside_range, ring);
        float square = r * r + h * h;
        covered += height < 1.0 ? 2.0 * h * h * r * ring / (square * square) : 0.0;
        direction = kGoldenTurn * direction;
    }
    return mix(1.0, kLetThrough, min(covered, 1.0));
}
