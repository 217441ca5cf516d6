// Names of objects, each centred in the middle of its box: a label is two triangles, pixel on pixel.
uniform samplerBuffer boxes;    // lower and upper corner [m]
uniform usamplerBuffer roots;   // of each object, its box
uniform usamplerBuffer labels;  // object; lower left corner in the atlas, width [pixels]
uniform mat4 world_to_clip;
uniform vec2 picture_size;   // [pixels]
uniform float label_height;  // [pixels]

flat out ivec2 from_picture_to_atlas;  // what to add to a pixel's place

void main() {
    uvec4 label = texelFetch(labels, gl_VertexID / 6);
    int root = int(texelFetch(roots, int(label.x)).x);
    vec3 center = 0.5 * (texelFetch(boxes, 2 * root).xyz + texelFetch(boxes, 2 * root + 1).xyz);
    vec4 clip = world_to_clip * vec4(center, 1.0);
    vec2 middle = (0.5 + 0.5 * clip.xy / clip.w) * picture_size;

    vec2 size = vec2(float(label.w), label_height);
    vec2 first = floor(middle - 0.5 * size);
    vec2 side = vec2(0x2c >> gl_VertexID % 6 & 1, 0x32 >> gl_VertexID % 6 & 1);
    vec2 at = 2.0 * (first + side * size) / picture_size - 1.0;
    gl_Position = clip.w > 0.0 ? vec4(at, 0.0, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
    from_picture_to_atlas = ivec2(label.yz) - ivec2(first);
}
