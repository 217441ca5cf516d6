// The light on a patch of floor, once a frame in a small texture, so that the floor's many pixels need one look
// each: the mean of 4 x 4 pixels of floor_visibility.frag.
uniform sampler2D visibility;
uniform vec2 pixel_size;  // in texture coordinates

in vec2 uv;
layout(location = 0) out vec4 blended;

void main() {  // each look is the mean of 2 x 2
    vec2 other = vec2(pixel_size.x, -pixel_size.y);
    blended = 0.25 * (textureLod(visibility, uv - pixel_size, 0.0) + textureLod(visibility, uv + pixel_size, 0.0) +
                      textureLod(visibility, uv - other, 0.0) + textureLod(visibility, uv + other, 0.0));
}
