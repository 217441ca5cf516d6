// The twelve edges of boxes, as lines that fade from level to level.
#include "render/include/line.glsl"

uniform samplerBuffer boxes;         // lower and upper corner [m]
uniform usamplerBuffer shown_boxes;  // index into boxes, level
uniform mat4 world_to_clip;

flat out vec4 line_color;

const vec3 kInk = vec3(0.05, 0.09, 0.20);
const float kFade = 0.6;  // from one level to the next

// Edges 4 k to 4 k + 3 go along axis k.
vec3 corner_of(int edge, float along) {
    vec2 across = vec2(edge & 1, edge >> 1 & 1);
    int axis = edge / 4;
    return axis == 0 ? vec3(along, across) : axis == 1 ? vec3(across.y, along, across.x) : vec3(across, along);
}

void main() {
    int edge = gl_VertexID / 6 % 12;
    uvec2 shown = texelFetch(shown_boxes, gl_VertexID / 72).xy;
    vec3 low = texelFetch(boxes, 2 * int(shown.x)).xyz;
    vec3 high = texelFetch(boxes, 2 * int(shown.x) + 1).xyz;
    vec4 a = world_to_clip * vec4(mix(low, high, corner_of(edge, 0.0)), 1.0);
    vec4 b = world_to_clip * vec4(mix(low, high, corner_of(edge, 1.0)), 1.0);
    place_line_corner(a, b, gl_VertexID % 6);
    line_color = vec4(kInk, pow(kFade, float(shown.y)));
}
