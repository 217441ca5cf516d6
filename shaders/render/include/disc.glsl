// Points distributed evenly over a disc: each direction is the previous one rotated by the golden angle (Vogel 1979).
const mat2 kGoldenTurn = mat2(-0.737368878, 0.675490294, -0.675490294, -0.737368878);

// A direction for each pixel, different from its neighbours' (interleaved gradient noise, Jimenez 2014).
vec2 pixel_direction() {
    float angle = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    return vec2(cos(angle), sin(angle));
}

// Distance of point i of n from the centre of the unit disc.
float disc_radius(int i, int n) { return sqrt((float(i) + 0.5) / float(n)); }
