// White with a dark outline, whose lightness contrasts with any colour.
uniform float opacity;

in vec3 corner;
layout(location = 0) out vec4 pixel;

const vec3 kFill = vec3(1.0, 0.98, 0.92);
const vec3 kInk = vec3(0.05, 0.03, 0.08);

void main() {
    vec3 distances = corner / fwidth(corner);  // from the edges [pixels]
    float nearest = min(distances.x, min(distances.y, distances.z));
    // Faces of few pixels would be all outline.
    float size = 1.0 / max(fwidth(corner.x), max(fwidth(corner.y), fwidth(corner.z)));
    float ink = clamp(1.5 - nearest, 0.0, 1.0) * clamp((size - 2.0) / 6.0, 0.0, 1.0);
    pixel = vec4(mix(kFill, kInk, ink), opacity);
}
