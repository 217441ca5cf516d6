// Stable neo-Hookean tets (Smith, de Goes, Kim 2018). With F the deformation gradient, I = F : F, J = det F, the energy
// over the volume at rest is mu/2 (I - 3 - log((I + 1) / 4)) - 3/4 mu (J - 1) + lambda/2 (J - 1)^2.
// CPU twin: src/cpu/elasticity/neo_hookean.inl.
#include "layouts/thresholds.glsl"
#include "sim/elasticity/strip.glsl"

uniform usamplerBuffer neo_hookean_strips;  // NeoHookeanStep, four texels each, in slices of rows; kNone pads
uniform usamplerBuffer neo_hookean_starts;  // of the slices

// All but the opening.
NeoHookeanStep fetch_neo_hookean_step(uint index) {
    int first = int(4u * index);
    uvec4 one = texelFetch(neo_hookean_strips, first);
    vec4 two = uintBitsToFloat(texelFetch(neo_hookean_strips, first + 1));
    vec4 three = uintBitsToFloat(texelFetch(neo_hookean_strips, first + 2));
    return NeoHookeanStep(one.x, one.y, uintBitsToFloat(one.z), uintBitsToFloat(one.w), two.x, two.y, two.z, two.w, three.x,
                          three.y, three.z, three.w, vec4(0.0));
}

// The force that opens the step's tet if it is collapsed [N].
vec3 opening_force(uint index, float squares) {
    if (squares >= kCollapsed) return vec3(0.0);
    return uintBitsToFloat(texelFetch(neo_hookean_strips, int(4u * index + 3u))).xyz;
}

// The gradient of the node's own shape function, in the rotated rest shape [1/m].
vec3 shape_gradient(NeoHookeanStep tet) {
    return -vec3(tet.aa + tet.ab + tet.ac, tet.bb + tet.bc, tet.cc);
}

// The gradient, over the rotated rest shape, of a field with these values at the vertices, less that at the node.
mat3 gradient_of(NeoHookeanStep tet, Strip strip) {
    return mat3(tet.aa * strip.a + tet.ab * strip.b + tet.ac * strip.c, tet.bb * strip.b + tet.bc * strip.c,
                tet.cc * strip.c);
}

// I = F : F.
float sum_of_squares(mat3 f) { return dot(f[0], f[0]) + dot(f[1], f[1]) + dot(f[2], f[2]); }

// What the energy depends on as a function of one corner.
struct TetAtCorner {
    vec3 stretched;  // F g
    vec3 slope;      // dJ/dx [1/m]
    float squares;   // I
    float ratio;     // J
};

TetAtCorner tet_at_corner(NeoHookeanStep tet, Strip strip) {
    mat3 f = gradient_of(tet, strip);
    vec3 slope = tet.aa * tet.bb * tet.cc * cross(strip.b - strip.a, strip.c - strip.a);
    return TetAtCorner(f * shape_gradient(tet), slope, sum_of_squares(f), -dot(strip.a, slope));
}

// [J]
float neo_hookean_energy(NeoHookeanStep tet, TetAtCorner at) {
    float dilation = at.ratio - 1.0;
    return 0.5 * tet.mu * (at.squares - 3.0 - log(0.25 * (at.squares + 1.0))) +
           (0.5 * tet.lambda * dilation - 0.75 * tet.mu) * dilation;
}

// The factors of F and cof F in the stress, times the volume at rest [J].
struct NeoHookeanStress {
    float shear, pressure;
};

NeoHookeanStress neo_hookean_stress(NeoHookeanStep tet, TetAtCorner at) {
    return NeoHookeanStress(tet.mu * at.squares / (at.squares + 1.0), tet.lambda * (at.ratio - 1.0) - 0.75 * tet.mu);
}

// The factor on the damping of a stretched tet.
float viscous_share(float squares) { return 4.0 / (squares + 1.0); }

// The viscous stress for the rate of strain sym(F^T change), with Lame's moduli, times g and the volume at rest.
vec3 viscous_traction(NeoHookeanStep tet, mat3 f, mat3 change, vec3 g) {
    float trace = dot(f[0], change[0]) + dot(f[1], change[1]) + dot(f[2], change[2]);
    vec3 twice_strain = (change * g) * f + (f * g) * change;
    return 0.75 * tet.mu * twice_strain + (tet.lambda - 0.625 * tet.mu) * trace * g;
}
