// Surfaces as computed by light_vertices.comp. TEXTURED: their light, and texture coordinates.
in vec4 clip_position;
#ifdef TEXTURED
in vec4 texture_light;
uniform samplerBuffer vertex_uvs;

out vec4 light;
out vec2 uv;
#else
in vec4 display_color;

out vec3 color;  // with perspective, without which large faces that reach behind the eye are black
#endif

void main() {
    gl_Position = clip_position;
#ifdef TEXTURED
    light = texture_light;
    uv = texelFetch(vertex_uvs, gl_VertexID).xy;
#else
    color = display_color.rgb;
#endif
}
