// From linear light to displayed values.

const float kShoulder = 0.72;  // up to where light is shown as it is
const float kBleach = 0.3;    // how soon what is brighter still turns white

// Above the shoulder, the strongest of the three colours approaches 1 and the others keep their ratio to it, so that bright
// jelly does not fade (Khronos 2024, PBR Neutral tone mapper).
vec3 compress(vec3 light) {
    float peak = max(light.r, max(light.g, light.b));
    float room = 1.0 - kShoulder;
    float over = max(peak - kShoulder, 0.0);
    float shown = min(peak, kShoulder) + room * over / (over + room);
    float white = 1.0 - 1.0 / (kBleach * (peak - shown) + 1.0);
    return mix(light * (shown / max(peak, 1e-6)), vec3(shown), white);
}

// sRGB's transfer curve from three square roots, which are cheaper than pow.
vec3 encode_srgb(vec3 linear) {
    vec3 a = sqrt(linear);
    vec3 b = sqrt(a);
    vec3 c = sqrt(b);
    return 0.585122381 * a + 0.783140355 * b - 0.368262736 * c;
}

vec3 to_display(vec3 light) { return clamp(encode_srgb(compress(max(light, vec3(0.0)))), 0.0, 1.0); }

// The alpha of finished pixels is what smooth_edges.frag finds edges by: luma on bodies, above 0 even for black ones; 0 around
// them.
vec4 body_pixel(vec3 display) { return vec4(display, 0.35 + 0.65 * dot(display, vec3(0.299, 0.587, 0.114))); }
vec4 surrounding_pixel(vec3 display) { return vec4(display, 0.0); }
