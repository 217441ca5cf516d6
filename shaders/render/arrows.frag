// An arrow, drawn by the distance of each pixel from it: dark, with a light outline that makes it visible on any background.
uniform float opacity;
uniform vec3 ink;          // sRGB
uniform float dot_radius;  // of a dot where it begins, in widths of its shaft; 0: none
uniform float line_scale;

noperspective in vec2 place;
flat in float arrow_length;
layout(location = 0) out vec4 pixel;

// In widths of the shaft. Short arrows consist of the head only, and it shrinks with them.
const float kHeadLength = 5.0, kHeadHalfWidth = 2.0, kShaftHalfWidth = 0.5, kRim = 0.6;
const float kFaded = 1.5;  // shorter ones fade
const vec3 kRimColor = vec3(1.0, 1.0, 0.97);

void main() {
    float back = place.x, across = abs(place.y);
    float head = min(kHeadLength, arrow_length), half_width = head * kHeadHalfWidth / kHeadLength;
    float in_head = max((across * head - back * half_width) / length(vec2(head, half_width) + 1e-6), back - head);
    float in_shaft = max(across - kShaftHalfWidth, max(head - back, back - arrow_length));
    float in_dot = length(vec2(back - arrow_length, across)) - dot_radius;
    float distance_ = min(in_head, in_shaft);  // [widths], negative inside
    if (dot_radius > 0.0) distance_ = min(distance_, in_dot);

    float pixels = 2.0 * line_scale;  // a width
    float inside = clamp(0.5 - distance_ * pixels, 0.0, 1.0);
    float all_ = clamp(0.5 - (distance_ - kRim) * pixels, 0.0, 1.0);
    float faded = dot_radius > 0.0 ? 1.0 : clamp(arrow_length / kFaded, 0.0, 1.0);
    pixel = vec4(mix(kRimColor, ink, inside), all_ * opacity * faded);
}
