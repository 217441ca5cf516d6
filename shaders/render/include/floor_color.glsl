// The colour of the floor under a given light.
#include "render/include/studio.glsl"

uniform vec3 floor_center;   // [m]
uniform float floor_radius;  // [m]

// @param visible how much of the key light and of the sky reaches it
vec3 floor_color(vec2 visible) {
    return kFloorAlbedo * (kKeyLight * to_key_light.y * visible.x + kSkyLight * visible.y);
}

// How far the floor blends into the backdrop, by the reciprocal of the distance, which is linear in the picture.
float floor_fade(vec2 xz) {
    float nearness = floor_radius / max(length(xz - floor_center.xz), 1e-6);
    return 1.0 - smoothstep(1.05, 6.5, nearness);
}
