// Points, lines and axes of attachments, bones and the nodes they carry: each a rectangle around a line that
// faces the screen, six vertices; render/marked_lines.frag draws the line in it, with round ends. A point is a
// line without length.
#include "render/include/cut.glsl"
#include "render/include/near_plane.glsl"

uniform samplerBuffer marked_lines;  // xyz of one end [m], what it is; xyz of the other end
uniform mat4 world_to_clip;
uniform vec2 picture_size;  // [pixels]
uniform float line_scale;

noperspective out vec2 place;  // along the line from its first end, and across it [pixels]
flat out float line_length;    // [pixels]
flat out float half_width;     // [pixels]
flat out vec3 ink;             // sRGB

const float kRoom = 3.0;  // round the line, for its rim [pixels]
// By what it is: a point of an attachment; a line between its two sides; an axis; a bone; a node that it
// carries. src/sim/overlay_line.h.
const float kHalfWidths[5] = float[](3.5, 1.0, 1.2, 2.5, 1.8);  // [pixels of a usual screen]
const vec3 kInks[5] = vec3[](vec3(0.02, 0.36, 0.72), vec3(0.02, 0.36, 0.72), vec3(0.60, 0.05, 0.50),
                             vec3(0.10, 0.10, 0.12), vec3(0.98, 0.78, 0.05));

void main() {
    vec4 from = texelFetch(marked_lines, 2 * (gl_VertexID / 6));
    vec3 to = texelFetch(marked_lines, 2 * (gl_VertexID / 6) + 1).xyz;
    int kind = clamp(int(from.w), 0, 4);
    vec4 a = world_to_clip * vec4(from.xyz, 1.0), b = world_to_clip * vec4(to, 1.0);
    bool is_hidden = cut_by_near_plane(a, b) || depth_below_cut(0.5 * (from.xyz + to)) < 0.0;

    vec2 pixels = 0.5 * picture_size;
    vec2 line = (b.xy / b.w - a.xy / a.w) * pixels;
    line_length = length(line);
    half_width = kHalfWidths[kind] * line_scale;
    ink = kInks[kind];
    vec2 along = line_length > 1e-3 ? line / line_length : vec2(1.0, 0.0);
    // Triangles of corners 0 2 1 and 1 2 3.
    int corner = gl_VertexID % 6;
    float side = (0x2c >> corner & 1) != 0 ? 1.0 : -1.0;
    bool is_end = (0x32 >> corner & 1) != 0;
    float room = half_width + kRoom * line_scale;
    place = vec2(is_end ? line_length + room : -room, side * room);
    vec4 end = is_end ? b : a;
    vec2 offset = (along * (is_end ? room : -room) + vec2(-along.y, along.x) * place.y) / pixels;
    gl_Position = is_hidden ? vec4(0.0, 0.0, 2.0, 1.0) : end + vec4(offset * end.w, 0.0, 0.0);
}
