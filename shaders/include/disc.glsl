// Sample patterns.
const float kGoldenAngle = 2.39996323;

// An angle for each pixel, such that neighbours differ (interleaved gradient noise, Jimenez 2014).
float pixel_angle() {
    return 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}

// Point i of n, spread evenly over the unit disc (Vogel 1979), turned by `turn`.
vec2 disc_point(int i, int n, float turn) {
    float angle = float(i) * kGoldenAngle + turn;
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}
