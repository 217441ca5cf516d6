// A straight line as two triangles that face the screen, some pixels wide: six vertices, corner 0 to 5. The fragment shader
// (render/line.frag) smooths its sides by the distance from its centre.
#include "render/include/near_plane.glsl"

uniform vec2 picture_size;  // [pixels]
uniform float line_width;   // [pixels]

noperspective out float across;  // from the middle of the line [pixels]

// a, b: its ends in clip coordinates.
void place_line_corner(vec4 a, vec4 b, int corner) {
    bool is_hidden = cut_by_near_plane(a, b);
    vec2 pixels = 0.5 * picture_size;
    vec2 along = (b.xy / b.w - a.xy / a.w) * pixels;
    along = dot(along, along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
    // Triangles of corners 0 2 1 and 1 2 3.
    float side = (0x2c >> corner & 1) != 0 ? 1.0 : -1.0;
    vec4 end = (0x32 >> corner & 1) != 0 ? b : a;
    across = side * (0.5 * line_width + 1.0);
    vec2 offset = vec2(-along.y, along.x) * across / pixels;
    gl_Position = is_hidden ? vec4(0.0, 0.0, 2.0, 1.0) : end + vec4(offset * end.w, 0.0, 0.0);
}
