// Surfaces as computed by light_vertices.comp.
in vec4 clip_position;
in vec4 display_color;

noperspective out vec3 color;  // on faces of a few pixels perspective is not visible

void main() {
    gl_Position = clip_position;
    color = display_color.rgb;
}
