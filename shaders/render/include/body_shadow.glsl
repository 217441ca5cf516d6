// How much of the key light reaches a body.
#include "render/include/studio.glsl"

uniform sampler2DShadow shadow_map;
uniform sampler2D shadow_depths;  // the same
uniform mat4 world_to_shadow;  // to texture coordinates and depth
uniform float shadow_bias;     // along the normal [m]
uniform float shadow_range;    // metres a unit of depth

#ifdef SOFT_SHADOWS
#include "render/include/disc.glsl"

uniform vec2 shadow_scale;     // texture coordinates a metre
uniform float penumbra_least;  // [m]

const int kTaps = 10;

// The mean over a disc that is the same for all pixels, so that there is no grain. Beside the point its own surface may
// lie nearer to the light, by its slope.
float key_visibility(vec3 position, vec3 normal) {
    vec3 at = (world_to_shadow * vec4(position + shadow_bias * normal, 1.0)).xyz;
    float facing = clamp(dot(normal, to_key_light), 0.3, 1.0);
    float slope = sqrt(1.0 - facing * facing) / (facing * shadow_range);  // depth a metre
    vec2 direction = vec2(1.0, 0.0);
    float lit = 0.0;
    int taps = dot(normal, to_key_light) > -0.2 ? kTaps : 0;  // none where nothing is lit anyway
    for (int i = 0; i < taps; ++i) {
        float away = disc_radius(i, kTaps) * penumbra_least;
        lit += textureLod(shadow_map, vec3(at.xy + direction * away * shadow_scale, at.z - slope * away), 0.0);
        direction = kGoldenTurn * direction;
    }
    return lit / float(kTaps);
}
#else
uniform float shadow_blur;  // in texture coordinates

float key_visibility(vec3 position, vec3 normal) {
    vec3 at = (world_to_shadow * vec4(position + shadow_bias * normal, 1.0)).xyz;
    return 0.5 * (textureLod(shadow_map, at + vec3(shadow_blur, 0.5 * shadow_blur, 0.0), 0.0) +
                  textureLod(shadow_map, at - vec3(shadow_blur, 0.5 * shadow_blur, 0.0), 0.0));
}
#endif
