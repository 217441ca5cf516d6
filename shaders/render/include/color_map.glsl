// Colours of a quantity (src/render/legend.h).
uniform vec3 value_colors[9];  // sRGB values
uniform float value_low, value_full;

vec3 color_of(float value) {
    float place = 8.0 * clamp((value - value_low) / (value_full - value_low), 0.0, 1.0);
    int stop = min(int(place), 7);
    return mix(value_colors[stop], value_colors[stop + 1], place - float(stop));
}
