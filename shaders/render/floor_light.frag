// The light on a patch of floor, once a frame in a small texture, so that the floor's many pixels need one look each.
// Red: the key light through a penumbra that grows with the distance of what casts it (Fernando 2005). Green: the sky
// that the bodies above leave free, by the form factor of each piece of their undersides.
layout(binding = 4) uniform sampler2D shadow_map;
layout(binding = 6) uniform sampler2D underside;  // height of the lowest surface over the floor / underside_range
uniform mat4 world_to_shadow;
uniform vec2 shadow_scale;      // texture coordinates a metre
uniform float shadow_range;     // metres a unit of depth
uniform float light_size;       // tangent of the key light's apparent radius
uniform float penumbra_least;   // [m]
uniform float penumbra_most;    // [m]
uniform float underside_range;  // [m]
uniform float sky_radius;       // how far round a point its sky is looked for [m]
uniform vec2 patch_corner;      // [m]
uniform vec2 patch_size;        // [m]
uniform float floor_height;     // [m]

in vec2 uv;
layout(location = 0) out vec4 visibility;

const int kSearchTaps = 12;
const int kShadowTaps = 24;
const int kSkyTaps = 40;
const float kGoldenAngle = 2.39996323;

// Point i of n, spread evenly over the unit disc (Vogel 1979).
vec2 disc(int i, int n) {
    float angle = float(i) * kGoldenAngle;
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}

float key_visibility(vec3 floor_point) {
    vec3 at = (world_to_shadow * vec4(floor_point, 1.0)).xyz;
    float blockers = 0.0;
    float depth = 0.0;
    for (int i = 0; i < kSearchTaps; ++i) {
        float d = textureLod(shadow_map, at.xy + disc(i, kSearchTaps) * penumbra_most * shadow_scale, 0.0).r;
        float blocks = d < 1.0 ? step(d, at.z) : 0.0;  // 1: nothing there
        blockers += blocks;
        depth += d * blocks;
    }
    float distance = blockers > 0.0 ? (at.z - depth / blockers) * shadow_range : penumbra_most / light_size;
    float radius = clamp(distance * light_size, penumbra_least, penumbra_most);
    float visible = 0.0;
    for (int i = 0; i < kShadowTaps; ++i) {
        float d = textureLod(shadow_map, at.xy + disc(i, kShadowTaps) * radius * shadow_scale, 0.0).r;
        visible += d < 1.0 ? step(at.z, d) : 1.0;
    }
    return visible / float(kShadowTaps);
}

// The part of the cosine-weighted hemisphere that undersides of height h at distance r cover: the sum of
// h^2 / (pi (r^2 + h^2)^2) dA over rings of equal width.
float sky_visibility() {
    float covered = 0.0;
    float ring = sky_radius / float(kSkyTaps);
    for (int i = 0; i < kSkyTaps; ++i) {
        float r = (float(i) + 0.5) * ring;
        float angle = float(i) * kGoldenAngle;
        vec2 at = uv + r * vec2(cos(angle), sin(angle)) / patch_size;
        float height = textureLod(underside, at, 0.0).r;
        float h = max(height * underside_range, ring);
        float form = 2.0 * h * h * r * ring / ((r * r + h * h) * (r * r + h * h));
        covered += height < 1.0 ? form : 0.0;
    }
    return 1.0 - 0.85 * min(covered, 1.0);  // jelly lets some through
}

void main() {
    vec2 xz = patch_corner + uv * patch_size;
    visibility = vec4(key_visibility(vec3(xz.x, floor_height, xz.y)), sky_visibility(), 0.0, 1.0);
}
