// The mean of what a tile of ambient_occlusion.frag found, of those pixels that show the same surface. The outermost
// rows and columns count half, so that each pixel of a tile counts alike and the middle stays in the middle.
uniform sampler2D occlusion;  // openness, distance [m], < 0 on the floor

uniform float same_surface;  // distances that differ by less belong together [m]

layout(location = 0) out vec2 blurred;

const int kHalf = 2;  // of a tile of 4

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(occlusion, 0) - 1;
    float distance = texelFetch(occlusion, pixel, 0).y;
    vec2 sum = vec2(0.0);
    for (int y = -kHalf; y <= kHalf; ++y) {
        for (int x = -kHalf; x <= kHalf; ++x) {
            vec2 other = texelFetch(occlusion, clamp(pixel + ivec2(x, y), ivec2(0), last), 0).xy;
            float weight = (abs(x) == kHalf ? 0.5 : 1.0) * (abs(y) == kHalf ? 0.5 : 1.0);
            weight *= max(other.y, distance) < 0.0 ? 1.0 : clamp(2.0 - abs(other.y - distance) / same_surface, 0.0, 1.0);
            sum += weight * vec2(other.x, 1.0);
        }
    }
    blurred = vec2(sum.x / sum.y, distance);
}
