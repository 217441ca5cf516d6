// A picture in the lower left corner of the other, pixel on pixel.
uniform sampler2D legend;

layout(location = 0) out vec4 pixel;

void main() { pixel = texelFetch(legend, ivec2(gl_FragCoord.xy), 0); }
