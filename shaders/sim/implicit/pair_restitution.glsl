// Of two objects.
uniform usamplerBuffer kinds;        // of objects
uniform samplerBuffer restitutions;  // of two kinds
uniform uint kind_count;

float restitution_of(uvec2 objects) {
    uint first = texelFetch(kinds, int(objects.x)).x, second = texelFetch(kinds, int(objects.y)).x;
    return texelFetch(restitutions, int(first * kind_count + second)).x;
}
