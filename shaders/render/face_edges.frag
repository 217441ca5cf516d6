// The edges of faces over their surface, each half drawn by either face. Where faces have few pixels the edges fade; otherwise
// they would cover everything.
uniform float line_width;  // [pixels]

in vec3 corner;
layout(location = 0) out vec4 pixel;

const vec4 kInk = vec4(0.03, 0.04, 0.09, 0.75);

void main() {
    vec3 step = fwidth(corner), distances = corner / step;  // from the edges [pixels]
    float nearest = min(distances.x, min(distances.y, distances.z));
    float size = 1.0 / max(step.x, max(step.y, step.z));
    float ink = clamp(0.5 * line_width + 0.5 - nearest, 0.0, 1.0) * clamp((size - 1.5) / 8.0, 0.0, 1.0);
    pixel = vec4(kInk.rgb, kInk.a * ink);
}
