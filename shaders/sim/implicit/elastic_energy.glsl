// The elastic energy of springs and tets [J]. Differences of nearly equal numbers are in double: what a part gains is little beside
// what is there. At `positions`, of sim/implicit/tets.glsl.
// CPU twin: gelatin::cpu::body_energy.

dvec3 place_of(uint n) { return dvec3(texelFetch(positions, int(n)).xyz); }

double spring_energy(Spring spring) {
    dvec3 apart = place_of(spring.j) - place_of(spring.i);
    double rest = double(spring.rest_length), square = dot(apart, apart);
    float stretch = float(square - rest * rest) / (sqrt(float(square)) + spring.rest_length);
    return 0.5LF * double(spring.stiffness) * double(stretch) * double(stretch);
}

#ifdef NEO_HOOKEAN
// x - log(1 + x), to relative rounding.
float less_its_logarithm(float x) {
    if (abs(x) > 0.1) return x - log(1.0 + x);
    return x * x * (1.0 / 2.0 - x * (1.0 / 3.0 - x * (1.0 / 4.0 - x * (1.0 / 5.0 - x * (1.0 / 6.0 - x * (1.0 / 7.0))))));
}

// With I = 3 + 4 x: mu/2 (4 x - log(1 + x)) - 3/4 mu (J - 1) + lambda/2 (J - 1)^2, times V.
double neo_hookean_energy(uint number, uvec4 tet) {
    int first = int(3u * number);
    vec4 one = texelFetch(neo_hookean_tets, first), two = texelFetch(neo_hookean_tets, first + 1),
         three = texelFetch(neo_hookean_tets, first + 2);
    dvec3 origin = place_of(tet.x);
    dmat3 f = outerProduct(place_of(tet.y) - origin, dvec3(one.xyz)) + outerProduct(place_of(tet.z) - origin, dvec3(two.xyz)) +
              outerProduct(place_of(tet.w) - origin, dvec3(three.xyz));
    double x = 0.25LF * (dot(f[0], f[0]) + dot(f[1], f[1]) + dot(f[2], f[2]) - 3.0LF);
    double dilation = dot(f[0], cross(f[1], f[2])) - 1.0LF;
    double mu = double(one.w) * double(two.w), lambda = double(one.w) * double(three.w);
    return mu * (1.5LF * x - 0.75LF * dilation + 0.5LF * double(less_its_logarithm(float(x)))) +
           0.5LF * lambda * dilation * dilation;
}
#endif

// With a neo-Hookean one's own, else of a flat one.
double tet_energy(uint t) {
    uvec4 tet = texelFetch(tets, int(t));
#ifdef NEO_HOOKEAN
    uint number = texelFetch(neo_hookean_numbers, int(t)).x;
    if (number != kNone) return neo_hookean_energy(number, tet);
#endif
    vec4 rest = texelFetch(tet_rests, int(t));
    mat3 sides = sides_of(tet);
    float lack = max(kFlattest - dot(sides[0], cross(sides[1], sides[2])) / (6.0 * rest.x), 0.0);
    return double(0.5 * rest.x * rest.y * lack * lack);
}
