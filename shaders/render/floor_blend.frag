// The light on a patch of floor, once a frame in a small texture, so that the floor's many pixels need one look
// each. Red: the key light, the mean of 4 x 4 pixels of floor_key.frag. Green: the sky, the same of floor_sky.frag.
layout(binding = 4) uniform sampler2D floor_key;
layout(binding = 6) uniform sampler2D floor_sky;
uniform vec2 key_pixel;  // in texture coordinates
uniform vec2 sky_pixel;

in vec2 uv;
layout(location = 0) out vec4 visibility;

// Each look is the mean of 2 x 2.
float mean(sampler2D map, vec2 pixel) {
    vec2 other = vec2(pixel.x, -pixel.y);
    return 0.25 * (textureLod(map, uv - pixel, 0.0).r + textureLod(map, uv + pixel, 0.0).r +
                   textureLod(map, uv - other, 0.0).r + textureLod(map, uv + other, 0.0).r);
}

void main() { visibility = vec4(mean(floor_key, key_pixel), mean(floor_sky, sky_pixel), 0.0, 1.0); }
