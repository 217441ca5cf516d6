// The sides of near pairs as rows have them.
// CPU twin: gelatin::cpu::ContactRows::make.
uniform usamplerBuffer kinds;      // of objects, as ContactSurface has them
uniform samplerBuffer touches;     // of two kinds: friction, stiffness
uniform uint kind_count;

vec2 touch_of(NearPair near) {
    uint first = texelFetch(kinds, int(near.object)).x, second = texelFetch(kinds, int(near.other)).x;
    return texelFetch(touches, int(first * kind_count + second)).xy;
}

// Of each side 1 in all: what contacts exert on both cancels but for rounding.
vec4 row_weights(NearPair near) {
    vec2 sums = vec2(0.0);
    for (int k = 0; k < 4; ++k) sums[side_of(near, k)] += near.weights[k];
    vec4 weights;
    for (int k = 0; k < 4; ++k) weights[k] = (side_of(near, k) == 0 ? -near.weights[k] : near.weights[k]) / sums[side_of(near, k)];
    return weights;
}
