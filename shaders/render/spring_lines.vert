// Springs as lines, coloured by their strain.
#include "render/include/cut.glsl"
#include "render/include/line.glsl"

uniform samplerBuffer node_positions;  // xyz [m]
uniform usamplerBuffer springs;        // Spring: two nodes, rest length [m], stiffness
uniform mat4 world_to_clip;
uniform float full_strain;
uniform vec3 strain_colors[5];  // from -full_strain to full_strain, sRGB values

flat out vec4 line_color;

const float kCalm = 0.1;  // opacity without strain: what is under strain shows through what is not

void main() {
    uvec4 spring = texelFetch(springs, gl_VertexID / 6);
    vec3 a = texelFetch(node_positions, int(spring.x)).xyz;
    vec3 b = texelFetch(node_positions, int(spring.y)).xyz;
    place_line_corner(world_to_clip * vec4(a, 1.0), world_to_clip * vec4(b, 1.0), gl_VertexID % 6);
    if (depth_below_cut(0.5 * (a + b)) < 0.0) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    float strain = distance(a, b) / uintBitsToFloat(spring.z) - 1.0;
    float at = clamp(strain / full_strain, -1.0, 1.0);
    float place = 2.0 * at + 2.0;
    int stop = min(int(place), 3);
    vec3 color = mix(strain_colors[stop], strain_colors[stop + 1], place - float(stop));
    line_color = vec4(color, mix(kCalm, 1.0, abs(at)));
}
