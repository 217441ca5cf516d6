// How much of the key light reaches a patch of floor, through a penumbra that grows with the distance of what
// casts it (Fernando 2005).
#include "render/include/disc.glsl"

uniform sampler2D shadow_map;
uniform mat4 world_to_shadow;   // to texture coordinates and depth
uniform vec2 shadow_scale;      // texture coordinates a metre
uniform float shadow_range;     // metres a unit of depth
uniform float light_size;       // tangent of the key light's apparent radius
uniform float penumbra_least;   // [m]
uniform float penumbra_most;    // [m]

#ifdef FEW_TAPS
const int kSearchTaps = 8, kShadowTaps = 12;
#else
const int kSearchTaps = 16, kShadowTaps = 20;
#endif

// 1 where something stands between the light and `at`. An empty map is at depth 1; the floor may lie behind that.
float blocks(float depth, float at) { return depth < 1.0 ? step(depth, at) : 0.0; }

// @param point of the floor [m]
// @param direction at random, unit length
float key_visibility(vec3 point, vec2 direction) {
    vec3 at = (world_to_shadow * vec4(point, 1.0)).xyz;
    float blockers = 0.0;
    float depth = 0.0;
    for (int i = 0; i < kSearchTaps; ++i) {
        vec2 offset = direction * (disc_radius(i, kSearchTaps) * penumbra_most);
        float d = textureLod(shadow_map, at.xy + offset * shadow_scale, 0.0).r;
        float blocked = blocks(d, at.z);
        blockers += blocked;
        depth += d * blocked;
        direction = kGoldenTurn * direction;
    }
    float distance = (at.z - depth / max(blockers, 1.0)) * shadow_range;
    float radius = clamp(distance * light_size, penumbra_least, penumbra_most);
    // All or nothing in the way needs no closer look; a loop of no turns is left sooner than a branch.
    int taps = blockers > 0.0 && blockers < float(kSearchTaps) ? kShadowTaps : 0;
    float blocked = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 offset = direction * (disc_radius(i, kShadowTaps) * radius);
        blocked += blocks(textureLod(shadow_map, at.xy + offset * shadow_scale, 0.0).r, at.z);
        direction = kGoldenTurn * direction;
    }
    return 1.0 - (taps > 0 ? blocked / float(kShadowTaps) : blockers / float(kSearchTaps));
}
