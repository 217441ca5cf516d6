#include "render/include/studio.glsl"

uniform vec2 picture_size;  // [pixels]

// The backdrop at a pixel: a slow gradient over the picture's height.
vec3 backdrop() {
    float height = gl_FragCoord.y / picture_size.y;
    return mix(kHorizon, kZenith, smoothstep(0.35, 1.25, height));
}
