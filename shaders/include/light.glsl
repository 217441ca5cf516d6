// The light on a body: ambient, diffuse and specular (Blinn and Phong), softened as on jelly. Called for each
// node, as the paper does, or for each pixel.
#include "include/floor_light.glsl"
#include "include/studio.glsl"

layout(binding = 4) uniform sampler2DShadow shadow_map;
uniform mat4 world_to_shadow;  // to texture coordinates and depth
uniform float shadow_bias;     // along the normal [m]
uniform float shadow_blur;     // in texture coordinates
uniform vec3 eye;              // [m]
uniform vec3 key_position;     // of the key light [m]: near enough that flat faces are not all of one shade
uniform float key_distance;    // at which it has its full strength [m]
uniform float floor_height;    // [m]
uniform float floor_reach;     // height up to which the floor's shading is felt [m]
uniform float jelly;           // 1: soft and glossy; 0: matt

float key_visibility(vec3 position, vec3 normal) {
    vec3 at = (world_to_shadow * vec4(position + shadow_bias * normal, 1.0)).xyz;
    return 0.5 * (textureLod(shadow_map, at + vec3(shadow_blur, 0.5 * shadow_blur, 0.0), 0.0) +
                  textureLod(shadow_map, at - vec3(shadow_blur, 0.5 * shadow_blur, 0.0), 0.0));
}

vec3 light_surface(vec3 position, vec3 normal, vec3 albedo) {
    vec3 to_eye = normalize(eye - position);
    vec3 to_key = key_position - position;
    float strength = key_distance * key_distance / dot(to_key, to_key);
    to_key = normalize(to_key);
    float facing = dot(normal, to_key);
    // Where the light grazes, the shadow map's own error would show, and the diffuse term is dark already.
    float lit = mix(1.0, key_visibility(position, normal), smoothstep(0.0, 0.3, facing));

    // Light that enters jelly comes out again beside the edge of the shadow and behind it, deeper in colour.
    float wrap = 0.35 * jelly;
    float diffuse = max((facing + wrap) / (1.0 + wrap), 0.0);
    vec3 deep = albedo * sqrt(albedo);
    vec3 key = mix(deep, albedo, clamp(diffuse * 1.5 + 1.0 - jelly, 0.0, 1.0)) * diffuse * lit;
    float through = 0.5 - 0.5 * facing;

    float nearness = clamp(1.0 - (position.y - floor_height) / floor_reach, 0.0, 1.0);
    // What a wall sees, not what it stands on.
    vec2 floor_before = position.xz + 0.12 * floor_reach * normal.xz;
    float floor_seen = mix(1.0, floor_visibility(floor_before).y, nearness);
    vec3 ambient = mix(kFloorLight * floor_seen, kSkyLight, 0.5 + 0.5 * normal.y);

    // A broad and a narrow highlight, and the sky in the rim (Schlick's approximation).
    float highlight = max(dot(normal, normalize(to_key + to_eye)), 0.0);
    float h4 = highlight * highlight * highlight * highlight;
    float h16 = h4 * h4 * h4 * h4;
    float h64 = h16 * h16 * h16 * h16;
    float gloss = (h16 * 0.07 + h64 * h64 * 0.75) * lit * step(0.0, facing);
    float edge = 1.0 - max(dot(normal, to_eye), 0.0);
    float rim = edge * edge * edge * clamp(0.35 + 0.65 * normal.y, 0.0, 1.0);

    return albedo * ambient + kKeyLight * strength * (0.85 * key + jelly * (gloss + 0.12 * through * deep)) +
           kSkyLight * rim * mix(0.1, 0.6, jelly) * mix(albedo, vec3(1.0), 0.5);
}
