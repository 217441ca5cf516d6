// The patch of floor round the scene in kTiles x kTiles tiles of two triangles each; those without shadow vanish, so
// that their pixels are never looked at.
uniform sampler2D floor_shade;
uniform mat4 world_to_clip;
uniform vec4 floor_patch;    // x, z of its corner [m]; 1 / its size [1/m]
uniform float floor_height;  // [m]

out vec2 uv;

const int kTiles = 16;
const int kLooks = 2;           // steps along a side, narrower than any shadow
const float kUnshaded = 0.998;  // half a step of 8 bits below 1

bool is_shaded(vec2 tile) {
    float least = 1.0;
    for (int i = 0; i <= kLooks; ++i) {
        for (int j = 0; j <= kLooks; ++j) {
            vec2 at = (tile + vec2(i, j) / float(kLooks)) / float(kTiles);
            least = min(least, textureLod(floor_shade, at, 0.0).r);
        }
    }
    return least < kUnshaded;
}

void main() {
    int index = gl_VertexID / 6;
    int corner = gl_VertexID % 6;
    vec2 tile = vec2(index % kTiles, index / kTiles);
    ivec2 side = ivec2((0x2c >> corner) & 1, (0x32 >> corner) & 1);  // triangles of corners 0 2 1 and 1 2 3
    uv = (tile + vec2(side)) / float(kTiles);
    vec2 xz = floor_patch.xy + uv / floor_patch.zw;
    gl_Position = is_shaded(tile) ? world_to_clip * vec4(xz.x, floor_height, xz.y, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
}
