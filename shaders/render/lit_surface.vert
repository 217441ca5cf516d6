// Surfaces as computed by light_vertices.comp.
layout(location = 0) in vec4 clip_position;
layout(location = 1) in vec4 display_color;

noperspective out vec3 color;  // over faces of a few pixels perspective does not show

void main() {
    gl_Position = clip_position;
    color = display_color.rgb;
}
