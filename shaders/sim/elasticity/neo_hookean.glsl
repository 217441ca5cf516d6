// Stable neo-Hookean tets (Smith, de Goes, Kim 2018). With F the deformation gradient, I = F : F, J = det F, the energy
// over the volume at rest is mu/2 (I - 3 - log((I + 1) / 4)) - 3/4 mu (J - 1) + lambda/2 (J - 1)^2.
// CPU twin: src/cpu/elasticity/neo_hookean.h.
#include "layouts/thresholds.glsl"
#include "layouts/packing.glsl"

uniform usamplerBuffer neo_hookean_tets;     // NeoHookeanTet, four texels each
uniform usamplerBuffer neo_hookean_corners;  // 4 tet + corner, in slices of rows; kNone pads
uniform usamplerBuffer neo_hookean_starts;   // of the slices


struct NeoHookeanTet {
    uvec4 nodes;
    vec3 gradient_1, gradient_2, gradient_3;  // of the shape functions at rest [1/m]
    float volume;                             // at rest [m^3]
    float mu, lambda;                         // [Pa]
};

NeoHookeanTet fetch_neo_hookean_tet(uint tet) {
    int first = int(4u * tet);
    vec4 one = uintBitsToFloat(texelFetch(neo_hookean_tets, first + 1));
    vec4 two = uintBitsToFloat(texelFetch(neo_hookean_tets, first + 2));
    vec4 three = uintBitsToFloat(texelFetch(neo_hookean_tets, first + 3));
    return NeoHookeanTet(texelFetch(neo_hookean_tets, first), one.xyz, two.xyz, three.xyz, one.w, two.w, three.w);
}

// The gradient of a corner's shape function at rest [1/m].
vec3 shape_gradient(NeoHookeanTet tet, uint corner) {
    if (corner == 1u) return tet.gradient_1;
    if (corner == 2u) return tet.gradient_2;
    if (corner == 3u) return tet.gradient_3;
    return -(tet.gradient_1 + tet.gradient_2 + tet.gradient_3);
}

// The gradient, over the rest shape, of a field with these values at the corners.
mat3 gradient_of(NeoHookeanTet tet, vec3 at_0, vec3 at_1, vec3 at_2, vec3 at_3) {
    return outerProduct(at_1 - at_0, tet.gradient_1) + outerProduct(at_2 - at_0, tet.gradient_2) +
           outerProduct(at_3 - at_0, tet.gradient_3);
}

// dJ/dF.
mat3 cofactor(mat3 f) { return mat3(cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1])); }

// I = F : F.
float sum_of_squares(mat3 f) { return dot(f[0], f[0]) + dot(f[1], f[1]) + dot(f[2], f[2]); }

// Over the volume at rest [J/m^3].
float neo_hookean_energy(mat3 f, float mu, float lambda) {
    float squares = sum_of_squares(f), dilation = dot(f[0], cross(f[1], f[2])) - 1.0;
    return 0.5 * mu * (squares - 3.0 - log(0.25 * (squares + 1.0))) + (0.5 * lambda * dilation - 0.75 * mu) * dilation;
}

// The factors of F and cof F in the stress, and the pressure against collapse [Pa].
struct NeoHookeanStress {
    float shear, pressure, opening;
};

NeoHookeanStress neo_hookean_stress(float squares, float volume_ratio, float mu, float lambda) {
    return NeoHookeanStress(mu * squares / (squares + 1.0), lambda * (volume_ratio - 1.0) - 0.75 * mu,
                            squares < kCollapsed ? mu : 0.0);
}

// The factor on the damping of a stretched tet.
float viscous_share(float squares) { return 4.0 / (squares + 1.0); }

// Viscous stress from the strain rate sym(F^T change), with Lame's moduli [Pa].
mat3 viscous_stress(mat3 f, mat3 change, float mu, float lambda) {
    mat3 product = transpose(f) * change;
    float trace = product[0].x + product[1].y + product[2].z;
    return 0.75 * mu * (product + transpose(product)) + mat3((lambda - 0.625 * mu) * trace);
}
