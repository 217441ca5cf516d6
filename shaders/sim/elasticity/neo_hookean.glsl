// Stable neo-Hookean tets (Smith, de Goes, Kim 2018). With F the deformation gradient, I = F : F, J = det F, the energy
// over the volume at rest is mu/2 (I - 3 - log((I + 1) / 4)) - 3/4 mu (J - 1) + lambda/2 (J - 1)^2.
// CPU twin: src/cpu/elasticity/neo_hookean.inl.
#include "layouts/thresholds.glsl"
#include "layouts/packing.glsl"
#include "layouts/neo_hookean_corner.glsl"

uniform usamplerBuffer neo_hookean_corners;  // NeoHookeanCorner, four texels each, in slices of rows; kNone pads
uniform usamplerBuffer neo_hookean_starts;   // of the slices

// All but the opening.
NeoHookeanCorner fetch_neo_hookean_corner(uint corner) {
    int first = int(4u * corner);
    uvec4 nodes = texelFetch(neo_hookean_corners, first);
    vec4 one = uintBitsToFloat(texelFetch(neo_hookean_corners, first + 1));
    vec4 two = uintBitsToFloat(texelFetch(neo_hookean_corners, first + 2));
    return NeoHookeanCorner(nodes.x, nodes.y, nodes.z, nodes.w, one.x, one.y, one.z, one.w, two.x, two.y, two.z, two.w,
                            vec4(0.0));
}

// The force that opens the tet if it is collapsed [N].
vec3 opening_force(uint corner, float squares) {
    if (squares >= kCollapsed) return vec3(0.0);
    return uintBitsToFloat(texelFetch(neo_hookean_corners, int(4u * corner + 3u))).xyz;
}

// The gradient of the corner's own shape function, in the rotated rest shape [1/m].
vec3 shape_gradient(NeoHookeanCorner tet) {
    return -vec3(tet.aa + tet.ab + tet.ac, tet.bb + tet.bc, tet.cc);
}

// The gradient, over the rotated rest shape, of a field with these differences of the corners a, b and c to this one.
mat3 gradient_of(NeoHookeanCorner tet, vec3 a, vec3 b, vec3 c) {
    return mat3(tet.aa * a + tet.ab * b + tet.ac * c, tet.bb * b + tet.bc * c, tet.cc * c);
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

TetAtCorner tet_at_corner(NeoHookeanCorner tet, vec3 a, vec3 b, vec3 c) {
    mat3 f = gradient_of(tet, a, b, c);
    vec3 slope = tet.aa * tet.bb * tet.cc * cross(b - a, c - a);
    return TetAtCorner(f * shape_gradient(tet), slope, sum_of_squares(f), -dot(a, slope));
}

// [J]
float neo_hookean_energy(NeoHookeanCorner tet, TetAtCorner at) {
    float dilation = at.ratio - 1.0;
    return 0.5 * tet.mu * (at.squares - 3.0 - log(0.25 * (at.squares + 1.0))) +
           (0.5 * tet.lambda * dilation - 0.75 * tet.mu) * dilation;
}

// The factors of F and cof F in the stress, times the volume at rest [J].
struct NeoHookeanStress {
    float shear, pressure;
};

NeoHookeanStress neo_hookean_stress(NeoHookeanCorner tet, TetAtCorner at) {
    return NeoHookeanStress(tet.mu * at.squares / (at.squares + 1.0), tet.lambda * (at.ratio - 1.0) - 0.75 * tet.mu);
}

// The factor on the damping of a stretched tet.
float viscous_share(float squares) { return 4.0 / (squares + 1.0); }

// The viscous stress for the rate of strain sym(F^T change), with Lame's moduli, times g and the volume at rest.
vec3 viscous_traction(NeoHookeanCorner tet, mat3 f, mat3 change, vec3 g) {
    float trace = dot(f[0], change[0]) + dot(f[1], change[1]) + dot(f[2], change[2]);
    vec3 twice_strain = (change * g) * f + (f * g) * change;
    return 0.75 * tet.mu * twice_strain + (tet.lambda - 0.625 * tet.mu) * trace * g;
}
