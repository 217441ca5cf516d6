// Light letters with a dark rim.
uniform sampler2D atlas;

flat in ivec2 from_picture_to_atlas;
layout(location = 0) out vec4 pixel;

void main() {
    vec2 found = texelFetch(atlas, ivec2(gl_FragCoord.xy) + from_picture_to_atlas, 0).rg;
    pixel = vec4(mix(vec3(0.04, 0.05, 0.08), vec3(1.0), found.r), found.g);
}
