// The light on a body: ambient, diffuse and specular (Blinn and Phong), softened as on jelly. Evaluated for each node, as in
// the paper, or for each pixel.
#include "render/include/body_shadow.glsl"
#include "render/include/floor_light.glsl"
#include "render/include/openness.glsl"
#include "render/include/studio.glsl"

uniform vec3 eye;              // [m]
uniform vec3 key_position;     // of the key light [m]: near enough that flat faces are not all of one shade
uniform float key_distance;    // at which it has its full strength [m]
uniform float floor_height;    // [m]
uniform float floor_reach;     // height up to which the floor's shading is felt [m]
uniform float free_path;       // of light in jelly [m]
uniform float jelly;           // 1: soft and glossy; 0: matt

const float kRoughness = 0.28;
const float kHead = 0.04;   // of light that comes straight on, what is mirrored
const float kGlaze = 0.55;  // of light that grazes, what roughness leaves

// The fraction of light that is reflected (Schlick 1994).
float schlick(float cosine) {
    float c = 1.0 - cosine, c2 = c * c;
    return kHead + (1.0 - kHead) * c2 * c2 * c;
}

// The highlight of a rough surface (Walter et al. 2007, GGX), by the cosine between normal and half vector; masking is that of
// a smooth surface.
float highlight(float cosine) {
    const float kSquare = kRoughness * kRoughness * kRoughness * kRoughness;
    float d = cosine * cosine * (kSquare - 1.0) + 1.0;
    return 0.25 * kSquare / (d * d);
}

// What a surface reflects from a direction: the floor below, the backdrop around.
vec3 around(vec3 direction, float floor_seen) {
    vec3 above = mix(kHorizon, kZenith, max(direction.y, 0.0));
    return mix(kFloorLight * floor_seen, above, smoothstep(-0.25, 0.25, direction.y));
}

// How much of the key light is transmitted to a body's far side, depending on the length of its path inside (Dachsbacher and
// Stamminger 2003, translucent shadow maps). Looked up slightly inside the surface, where the map contains the body.
float key_transmission(vec3 position, vec3 normal) {
    vec3 at = (world_to_shadow * vec4(position - shadow_bias * normal, 1.0)).xyz;
    vec4 inside = max(at.z - textureGather(shadow_depths, at.xy), 0.0);
    return exp(-dot(inside, vec4(0.25)) * shadow_range / free_path);
}

// @param openness fraction of the ambient light that is not occluded nearby
vec3 light_surface(vec3 position, vec3 normal, vec3 albedo, float openness) {
    vec3 to_eye = normalize(eye - position);
    vec3 to_key = key_position - position;
    float strength = key_distance * key_distance / dot(to_key, to_key);
    to_key = normalize(to_key);
    float facing = dot(normal, to_key);
    // At grazing incidence the shadow map's error would be visible, and the diffuse term is dark already.
    float lit = mix(1.0, key_visibility(position, normal), smoothstep(0.0, 0.3, facing));

    // Light that enters jelly leaves it again near the edge of the shadow and behind it, with a deeper colour.
    float wrap = 0.35 * jelly;
    float diffuse = max((facing + wrap) / (1.0 + wrap), 0.0);
    vec3 deep = albedo * sqrt(albedo);
    vec3 key = mix(deep, albedo, clamp(diffuse * 1.5 + 1.0 - jelly, 0.0, 1.0)) * diffuse * lit;
    float through = key_transmission(position, normal) * clamp(0.4 - 0.8 * facing, 0.0, 1.0);

    float nearness = clamp(1.0 - (position.y - floor_height) / floor_reach, 0.0, 1.0);
    // What a vertical surface sees, not what it stands on.
    vec2 floor_before = position.xz + 0.12 * floor_reach * normal.xz;
    float floor_seen = mix(1.0, floor_visibility(floor_before).y, nearness);
    vec3 ambient = mix(kFloorLight * floor_seen, kSkyLight, 0.5 + 0.5 * normal.y) * with_bounces(openness, albedo);

    vec3 half_way = normalize(to_key + to_eye);
    float gloss = highlight(max(dot(normal, half_way), 0.0)) * schlick(max(dot(to_eye, half_way), 0.0)) *
                  max(facing, 0.0) * lit;
    float edge = schlick(max(dot(normal, to_eye), 0.0)) * kGlaze;
    vec3 mirrored = around(reflect(-to_eye, normal), floor_seen) * openness;

    return albedo * ambient + kKeyLight * strength * (0.85 * key + jelly * (gloss + 0.5 * through * deep)) +
           mirrored * edge * mix(0.2, 1.0, jelly);
}
