// Lines with soft sides.
uniform float line_width;  // [pixels]
uniform float opacity;

noperspective in float across;  // [pixels]
flat in vec4 line_color;        // sRGB values, opacity
layout(location = 0) out vec4 pixel;

void main() {
    float coverage = clamp(0.5 * line_width + 0.5 - abs(across), 0.0, 1.0);
    pixel = vec4(line_color.rgb, opacity * line_color.a * coverage);
}
