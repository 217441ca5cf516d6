// What elements add to a node: a force, and how it falls as the node moves. CPU twin: src/cpu/elasticity/node_terms.inl.

#include "layouts/thresholds.glsl"

struct NodeTerms {
    vec3 force;     // [N]
    vec3 diagonal;  // xx, yy, zz of the Hessian [N/m]
    vec3 beside;    // yz, zx, xy
};

// kappa phi'(J - 1) of the volume term [Pa].
float volume_stress(float ratio, float kappa) {
    float u = ratio - 1.0;
    float left = max(1.0 - 4.0 * u * u, 0.0);
    return kappa >= 0.0 ? kappa * u : kappa * u * left * left;
}

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
