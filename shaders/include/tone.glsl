// From linear light to what a screen shows.

// Film's shoulder: linear in the dark, never quite white.
vec3 compress(vec3 light) { return 1.0 - exp(-light); }

// sRGB's transfer curve from three square roots, which are cheaper than pow.
vec3 encode_srgb(vec3 linear) {
    vec3 a = sqrt(linear);
    vec3 b = sqrt(a);
    vec3 c = sqrt(b);
    return 0.585122381 * a + 0.783140355 * b - 0.368262736 * c;
}

vec3 to_display(vec3 light) { return clamp(encode_srgb(compress(max(light, vec3(0.0)))), 0.0, 1.0); }

// Finished pixels carry in alpha what smooth_edges.frag tells edges by: luma on bodies, which even black ones set off
// from the 0 of all that surrounds them.
vec4 body_pixel(vec3 display) { return vec4(display, 0.35 + 0.65 * dot(display, vec3(0.299, 0.587, 0.114))); }
vec4 surrounding_pixel(vec3 display) { return vec4(display, 0.0); }
