// What one element of a body adds to a node's part of the objective of a step: a force and a positive semi-definite
// second derivative. CPU twin: src/cpu/elasticity/elements.inl.

#include "layouts/thresholds.glsl"

struct NodeTerms {
    vec3 force;     // [N]
    vec3 diagonal;  // xx, yy, zz of the Hessian [N/m]
    vec3 beside;    // yz, zx, xy
};

void add_outer(float factor, vec3 v, inout NodeTerms terms) {
    terms.diagonal += factor * v * v;
    terms.beside += factor * v.yzx * v.zxy;
}

// The spring to a node `apart` from this one, its damper in it (damp_springs.comp). One of no length adds nothing.
void add_spring(vec3 apart, float rest_length, float stiffness, inout NodeTerms terms) {
    float inverse_length = inversesqrt(max(dot(apart, apart), 1e-30));
    float scale = stiffness - stiffness * rest_length * inverse_length;
    terms.force += scale * apart;
    float across = max(scale, 0.0);
    add_outer(stiffness - across, inverse_length * apart, terms);
    terms.diagonal += across;
}

// A tet flatter than kFlattest, as one of its corners sees it: its J is `ratio`, dJ/dx `slope` [1/m].
void add_flat_tet(vec3 slope, float ratio, float stiffness, inout NodeTerms terms) {
    float lack = max(kFlattest - ratio, 0.0);
    terms.force += stiffness * lack * slope;
    add_outer(lack > 0.0 ? stiffness : 0.0, slope, terms);
}

// kappa phi'(J - 1) of the volume term [Pa].
float volume_stress(float ratio, float kappa) {
    float u = ratio - 1.0;
    float left = max(1.0 - 4.0 * u * u, 0.0);
    return kappa >= 0.0 ? kappa * u : kappa * u * left * left;
}

// A tet's part of the volume term. @param bound its offset and modulus, times the volume at rest [J]
void add_tet_volume(vec3 slope, float ratio, vec2 bound, inout NodeTerms terms) {
    terms.force -= (bound.x + bound.y * ratio) * slope;
    add_outer(bound.y, slope, terms);
}

vec3 stiffness_times(NodeTerms terms, vec3 v) { return terms.diagonal * v + terms.beside.zxy * v.yzx + terms.beside.yzx * v.zxy; }

// Of a pivot; one that drowns in the rounding of what it is left over from counts as that.
float inverse_or_zero(float pivot, float diagonal) {
    float d = max(pivot, 9.5367431640625e-7 * diagonal);  // 8 epsilon
    return d > 0.0 ? 1.0 / d : 0.0;
}

// hessian^-1 v by the square-root-free Cholesky decomposition; zero along what has no stiffness.
vec3 solve(NodeTerms terms, vec3 v) {
    vec3 d = terms.diagonal, b = terms.beside;
    float i0 = inverse_or_zero(d.x, d.x);
    float l10 = b.z * i0, l20 = b.y * i0;
    float i1 = inverse_or_zero(d.y - l10 * b.z, d.y);
    float rest = b.x - l20 * b.z, l21 = rest * i1;
    float i2 = inverse_or_zero(d.z - l20 * b.y - l21 * rest, d.z);
    float y1 = v.y - l10 * v.x, y2 = v.z - l20 * v.x - l21 * y1;
    float z = y2 * i2, y = y1 * i1 - l21 * z;
    return vec3(v.x * i0 - l10 * y - l20 * z, y, z);
}
