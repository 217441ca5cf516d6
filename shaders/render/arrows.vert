// Arrows from nodes of the surface, of velocities or forces: each a rectangle around it that faces the screen, six vertices;
// render/arrows.frag draws the arrow in it.
#include "render/include/cut.glsl"
#include "render/include/near_plane.glsl"

uniform samplerBuffer node_positions;  // xyz [m]
uniform samplerBuffer vectors;         // xyz [m/s] or [N]
uniform usamplerBuffer arrow_nodes;
uniform mat4 world_to_clip;
uniform vec2 picture_size;  // [pixels]
uniform float arrow_scale;  // [s] or [m/N]
uniform float line_scale;

noperspective out vec2 place;  // along the arrow, back from its tip, and across it, in widths of its shaft
flat out float arrow_length;

const float kRoom = 5.0;  // round the arrow, for its head and its rim

void main() {
    int node = int(texelFetch(arrow_nodes, gl_VertexID / 6).x);
    vec3 from = texelFetch(node_positions, node).xyz;
    vec4 a = world_to_clip * vec4(from, 1.0);
    vec4 b = world_to_clip * vec4(from + arrow_scale * texelFetch(vectors, node).xyz, 1.0);
    bool is_hidden = cut_by_near_plane(a, b) || depth_below_cut(from) < 0.0;

    vec2 pixels = 0.5 * picture_size;
    vec2 arrow = (b.xy / b.w - a.xy / a.w) * pixels;
    float width = 2.0 * line_scale;  // [pixels]
    arrow_length = length(arrow) / width;
    vec2 along = arrow_length > 1e-3 ? normalize(arrow) : vec2(1.0, 0.0);
    // Triangles of corners 0 2 1 and 1 2 3.
    int corner = gl_VertexID % 6;
    float side = (0x2c >> corner & 1) != 0 ? 1.0 : -1.0;
    bool is_tip = (0x32 >> corner & 1) != 0;
    place = vec2(is_tip ? -kRoom : arrow_length + kRoom, side * kRoom);
    vec4 end = is_tip ? b : a;
    vec2 offset = (along * (is_tip ? kRoom : -kRoom) + vec2(-along.y, along.x) * place.y) * width / pixels;
    gl_Position = is_hidden ? vec4(0.0, 0.0, 2.0, 1.0) : end + vec4(offset * end.w, 0.0, 0.0);
}
