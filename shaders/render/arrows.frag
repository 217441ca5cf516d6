// An arrow, drawn by the distance of each pixel from it: dark, with a light outline that makes it visible on any background.
uniform float opacity;
uniform float line_scale;

noperspective in vec2 place;
flat in float arrow_length;
layout(location = 0) out vec4 pixel;

// In widths of the shaft. Short arrows consist of the head only, and it shrinks with them.
const float kHeadLength = 5.0, kHeadHalfWidth = 2.0, kShaftHalfWidth = 0.5, kRim = 0.6;
const float kFaded = 1.5;  // shorter ones fade
const vec3 kInk = vec3(0.05, 0.07, 0.20), kRimColor = vec3(1.0, 1.0, 0.97);

void main() {
    float back = place.x, across = abs(place.y);
    float head = min(kHeadLength, arrow_length), half_width = head * kHeadHalfWidth / kHeadLength;
    float in_head = max((across * head - back * half_width) / length(vec2(head, half_width) + 1e-6), back - head);
    float in_shaft = max(across - kShaftHalfWidth, max(head - back, back - arrow_length));
    float distance_ = min(in_head, in_shaft);  // [widths], negative inside

    float pixels = 2.0 * line_scale;  // a width
    float ink = clamp(0.5 - distance_ * pixels, 0.0, 1.0);
    float all_ = clamp(0.5 - (distance_ - kRim) * pixels, 0.0, 1.0);
    pixel = vec4(mix(kRimColor, kInk, ink), all_ * opacity * clamp(arrow_length / kFaded, 0.0, 1.0));
}
