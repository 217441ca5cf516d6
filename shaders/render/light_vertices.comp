// The paper's light (3.1): one invocation lights one surface vertex and computes its clip coordinates, so that drawing only
// fetches a position and a finished colour. TEXTURED: also the light itself, for pixels that have their albedo from a texture.
// Test: tests/render/vertex_light_test.cpp.
#include "include/global_index.glsl"
#include "render/include/light.glsl"
#include "render/include/surface_fetch.glsl"
#include "render/include/tone.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer object_colors;  // linear RGB
layout(std430) writeonly buffer ClipPositions { vec4 clip_positions[]; };
layout(std430) writeonly buffer DisplayColors { uint display_colors[]; };  // RGBA8, sRGB values
#ifdef TEXTURED
layout(std430) writeonly buffer TextureLights { vec4 texture_lights[]; };  // rgb: over the albedo; a: what is mirrored
#endif
uniform mat4 world_to_clip;
uniform uint vertex_count;

void main() {
    uint v = global_index();
    if (v >= vertex_count) return;
    SurfacePoint point = fetch_point(int(v));
    vec3 albedo = texelFetch(object_colors, int(point.object)).rgb;
    vec3 light = light_surface(point.position, fetch_normal(int(v)), albedo, 1.0);
    clip_positions[v] = world_to_clip * vec4(point.position, 1.0);
    display_colors[v] = packUnorm4x8(vec4(to_display(light), 1.0));
#ifdef TEXTURED
    // Light is not quite linear in the albedo: its slope is that up to a middle grey.
    const float kGrey = 0.5;
    vec3 mirrored = light_surface(point.position, fetch_normal(int(v)), vec3(0.0), 1.0);
    vec3 grey = light_surface(point.position, fetch_normal(int(v)), vec3(kGrey), 1.0);
    texture_lights[v] = vec4((grey - mirrored) / kGrey, dot(mirrored, vec3(0.2126, 0.7152, 0.0722)));
#endif
}
