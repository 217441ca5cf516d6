// How much of the ambient light reaches the surface that a pixel shows, as AmbientOcclusion found it in a picture of
// half the size.
#ifdef AMBIENT_OCCLUSION
uniform sampler2D occlusion;  // openness, distance [m], < 0 on the floor
uniform vec2 occlusion_scale;                     // its pixels by those of the picture
uniform float same_surface;                       // distances that differ by less belong together [m]

// Of the four nearest, those of the same surface.
// @param side -1 on the floor, else 1
float pixel_openness(float side) {
    vec2 at = gl_FragCoord.xy * occlusion_scale - 0.5;
    vec2 corner = floor(at), f = at - corner;
    vec2 uv = (corner + 1.0) / vec2(textureSize(occlusion, 0));
    vec4 away = min(abs(textureGather(occlusion, uv, 1) - side / gl_FragCoord.w) / same_surface, 1e3);
    vec4 weight = vec4((1.0 - f.x) * f.y, f.x * f.y, f.x * (1.0 - f.y), (1.0 - f.x) * (1.0 - f.y));
    weight = (weight + 1e-3) / (1.0 + away * away * away * away);
    return dot(weight, textureGather(occlusion, uv, 0)) / dot(weight, vec4(1.0));
}

// Light that an occluder of the same colour throws back is not lost (Jimenez et al. 2016, eq. 10).
vec3 with_bounces(float openness, vec3 albedo) {
    vec3 a = 2.0404 * albedo - 0.3324, b = 4.7951 * albedo - 0.6417, c = 2.7552 * albedo + 0.6903;
    return max(vec3(openness), ((openness * a - b) * openness + c) * openness);
}
#else
float pixel_openness(float side) { return 1.0; }
vec3 with_bounces(float openness, vec3 albedo) { return vec3(1.0); }
#endif
