// Names of objects, centred in the middle of their boxes: a letter is two triangles, pixel on pixel.
layout(binding = 0) uniform samplerBuffer boxes;     // lower and upper corner [m]
layout(binding = 1) uniform usamplerBuffer roots;    // of each object, its box
layout(binding = 2) uniform usamplerBuffer letters;  // object; glyph, place in the label << 16, label's length << 24
uniform mat4 world_to_clip;
uniform vec2 picture_size;  // [pixels]
uniform int enlargement;

flat out ivec2 cell_corner;  // of the letter's cell in the picture [pixels]
flat out int glyph;

const vec2 kCell = vec2(7.0, 9.0);  // as in src/render/label_overlay.cpp
const float kAdvance = 6.0;

void main() {
    uvec2 letter = texelFetch(letters, gl_VertexID / 6).xy;
    int root = int(texelFetch(roots, int(letter.x)).x);
    vec3 center = 0.5 * (texelFetch(boxes, 2 * root).xyz + texelFetch(boxes, 2 * root + 1).xyz);
    vec4 clip = world_to_clip * vec4(center, 1.0);
    vec2 middle = (0.5 + 0.5 * clip.xy / clip.w) * picture_size;

    float scale = float(enlargement);
    float column = float(letter.y >> 16u & 255u), length_ = float(letter.y >> 24u);
    vec2 from_middle = vec2(kAdvance * (column - 0.5 * length_) - 0.5, -0.5 * kCell.y);
    vec2 first = floor(middle + scale * from_middle);
    vec2 side = vec2(0x2c >> gl_VertexID % 6 & 1, 0x32 >> gl_VertexID % 6 & 1);
    vec2 at = 2.0 * (first + side * scale * kCell) / picture_size - 1.0;
    gl_Position = clip.w > 0.0 ? vec4(at, 0.0, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
    cell_corner = ivec2(first);
    glyph = int(letter.y & 0xffffu);
}
