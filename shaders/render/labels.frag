// Light letters with a dark rim.
layout(binding = 7) uniform sampler2D font;
uniform int enlargement;

flat in ivec2 cell_corner;
flat in int glyph;
layout(location = 0) out vec4 pixel;

const int kCellWidth = 7;  // as in src/render/label_overlay.cpp

void main() {
    ivec2 at = (ivec2(floor(gl_FragCoord.xy)) - cell_corner) / enlargement;
    vec2 found = texelFetch(font, ivec2(glyph * kCellWidth, 0) + at, 0).rg;
    pixel = vec4(mix(vec3(0.04, 0.05, 0.08), vec3(1.0), found.r), found.g);
}
