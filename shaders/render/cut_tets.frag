// A cut through tets, in flat light, with the tets' sides as thin lines.
#ifdef COLOR_MAP
#include "render/include/color_map.glsl"
#endif
#include "render/include/studio.glsl"
#include "render/include/tone.glsl"

uniform float line_width;  // [pixels]
uniform vec4 cut_plane;    // unit normal

in vec4 side_distances;
flat in float polygon_size;
#ifdef COLOR_MAP
flat in float value;
#else
flat in vec3 albedo;
#endif
layout(location = 0) out vec4 pixel;

const float kLeft = 0.5;  // what lines leave of the colour

void main() {
    vec4 distances = side_distances / max(fwidth(side_distances), vec4(1e-30));  // [pixels]
    float nearest = min(min(distances.x, distances.y), min(distances.z, distances.w));
    // In tets of few pixels the lines would cover everything.
    float ink = clamp(0.5 * line_width + 0.5 - nearest, 0.0, 1.0) * clamp((polygon_size - 2.0) / 12.0, 0.0, 1.0);
#ifdef COLOR_MAP
    vec3 color = color_of(value);
#else
    vec3 color = to_display(albedo * (0.5 * kSkyLight + kKeyLight * (0.3 + 0.15 * dot(cut_plane.xyz, to_key_light))));
#endif
    pixel = body_pixel(color * mix(1.0, kLeft, ink));
}
