// The light on a body: ambient, diffuse and specular (Blinn and Phong), softened as on jelly. Called for each node, as
// the paper does, or for each pixel.
#include "include/floor_light.glsl"
#include "include/studio.glsl"

layout(binding = 4) uniform sampler2DShadow shadow_map;
uniform mat4 world_to_shadow;  // to texture coordinates and depth
uniform float shadow_bias;     // along the normal [m]
uniform float shadow_blur;     // in texture coordinates
uniform vec3 eye;              // [m]
uniform float floor_height;    // [m]
uniform float floor_reach;     // height up to which the floor's shading is felt [m]
uniform float jelly;           // 1: soft and glossy; 0: matt

float key_visibility(vec3 position, vec3 normal) {
    vec3 at = (world_to_shadow * vec4(position + shadow_bias * normal, 1.0)).xyz;
    float sum = textureLod(shadow_map, at + vec3(0.4, 1.0, 0.0) * shadow_blur, 0.0);
    sum += textureLod(shadow_map, at + vec3(-1.0, 0.4, 0.0) * shadow_blur, 0.0);
    sum += textureLod(shadow_map, at + vec3(-0.4, -1.0, 0.0) * shadow_blur, 0.0);
    sum += textureLod(shadow_map, at + vec3(1.0, -0.4, 0.0) * shadow_blur, 0.0);
    return 0.25 * sum;
}

vec3 light_surface(vec3 position, vec3 normal, vec3 albedo) {
    vec3 to_eye = normalize(eye - position);
    float facing = dot(normal, to_key_light);
    // Where the light grazes, the shadow map's own error would show, and the diffuse term is dark already.
    float lit = mix(1.0, key_visibility(position, normal), smoothstep(0.0, 0.3, facing));

    // Light that enters jelly comes out again beside the edge of the shadow, more strongly coloured.
    float wrap = 0.4 * jelly;
    float diffuse = max((facing + wrap) / (1.0 + wrap), 0.0);
    vec3 scattered = mix(albedo * albedo * 1.3, albedo, clamp(diffuse * 1.6, 0.0, 1.0));
    vec3 key = mix(albedo, scattered, jelly) * (diffuse * diffuse * 0.35 + diffuse * 0.65) * lit;

    float nearness = clamp(1.0 - (position.y - floor_height) / floor_reach, 0.0, 1.0);
    float floor_seen = mix(1.0, floor_visibility(position.xz).y, nearness);
    vec3 ambient = mix(kFloorLight * floor_seen, kSkyLight, 0.5 + 0.5 * normal.y);

    // A broad and a narrow highlight, and the sky in the rim (Schlick's approximation).
    float highlight = max(dot(normal, normalize(to_key_light + to_eye)), 0.0);
    float h4 = highlight * highlight * highlight * highlight;
    float h16 = h4 * h4 * h4 * h4;
    float h64 = h16 * h16 * h16 * h16;
    float broad = h16 * 0.10;
    float narrow = h64 * h64 * 0.55;
    float edge = 1.0 - max(dot(normal, to_eye), 0.0);
    float rim = edge * edge * edge * (0.25 + 0.75 * edge) * mix(0.35, 1.0, 0.5 + 0.5 * normal.y);

    return albedo * ambient + kKeyLight * (key * 0.8 + vec3(broad + narrow) * lit * step(0.0, facing) * jelly) +
           kSkyLight * rim * mix(0.15, 0.75, jelly) * floor_seen;
}
