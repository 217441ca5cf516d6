// Surfaces as light_vertices.comp left them.
in vec4 clip_position;
in vec4 display_color;

noperspective out vec3 color;  // over faces of a few pixels perspective does not show

void main() {
    gl_Position = clip_position;
    color = display_color.rgb;
}
