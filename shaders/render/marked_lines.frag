// A line with round ends, with a light outline that makes it visible on any background.
uniform float opacity;
uniform float line_scale;

noperspective in vec2 place;
flat in float line_length;
flat in float half_width;
flat in vec3 ink;
layout(location = 0) out vec4 pixel;

const float kRim = 1.2;  // [pixels of a usual screen]
const vec3 kRimColor = vec3(1.0, 1.0, 0.97);

void main() {
    vec2 from_line = vec2(place.x - clamp(place.x, 0.0, line_length), place.y);
    float beyond = length(from_line) - half_width;  // [pixels], negative inside
    float inside = clamp(0.5 - beyond, 0.0, 1.0);
    float all_ = clamp(0.5 - (beyond - kRim * line_scale), 0.0, 1.0);
    pixel = vec4(mix(kRimColor, ink, inside), all_ * opacity);
}
