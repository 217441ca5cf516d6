// A picture in the lower left corner of the other, pixel on pixel.
uniform sampler2D legend;
uniform vec2 picture_size;  // [pixels]

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * vec2(textureSize(legend, 0));
    gl_Position = vec4(2.0 * corner / picture_size - 1.0, 0.0, 1.0);
}
