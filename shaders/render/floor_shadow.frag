// Darkens the floor that is in the picture already.
uniform sampler2D floor_shade;

in vec2 uv;
layout(location = 0) out vec4 factor;

void main() { factor = textureLod(floor_shade, uv, 0.0); }
