// Noise of up to half a step of 8 bits, so that slow gradients show no bands (interleaved gradient noise, Jimenez 2014).
float dither() {
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    return (noise - 0.5) / 255.0;
}
