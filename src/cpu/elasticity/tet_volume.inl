// What resists changes of volume; see elements.inl. GLSL twins: shaders/sim/elasticity/node_terms.glsl,
// volume_term.glsl.

/// dJ/dx of a tet as seen from one of its corners [1/m], with J its volume over that at rest, V; linear in
/// the corner's position.
/// @param ab, ac edges from one of the other corners, a, to those that follow, counter-clockwise as seen from
/// the corner @param inverse_six_volumes 1 / (6 V) [1/m^3]
template <class Real>
Vec3<Real> volume_slope(const Vec3<Real>& ab, const Vec3<Real>& ac, Real inverse_six_volumes) {
    return inverse_six_volumes * cross(ab, ac);
}

/// A flat tet of springs, with J_0 = kFlattest and K its modulus: W = V K / 2 (J_0 - J)^2 where J < J_0,
/// otherwise 0 [J]. It moves springs out of mirrored and tangled shapes, in which they would also be at rest.
/// @param ratio J @param stiffness V K [J]
template <class Real>
Real flat_tet_energy(Real ratio, Real stiffness) {
    const Real lack = larger(Real(kFlattest) - ratio, Real(0));
    return Real(0.5f) * stiffness * lack * lack;
}

///   force   V K (J_0 - J) dJ/dx,   hessian V K dJ/dx dJ/dx^T where J < J_0.
/// @param slope dJ/dx [1/m]
template <class Real, class Hessian>
void add_flat_tet(const Vec3<Real>& slope, Real ratio, Real stiffness, NodeTerms<Real, Hessian>& terms) {
    const Real lack = Real(kFlattest) - ratio;
    const Real resisting = select(lack > Real(0), stiffness, Real(0));
    terms.force = multiply_add(resisting * lack, slope, terms.force);
    terms.hessian.add_outer(resisting, slope);
}

/// phi(J - 1) of the volume term, with J the volume around a node relative to that at rest: its energy over
/// kappa and the volume at rest. phi(u) = u^2 / 2 if kappa > 0. If it is negative, the term takes energy out
/// of a body that grows, and must be bounded: phi'(u) = u (1 - (u / a)^2)^2 up to |u| = a = 1/2, and 0
/// beyond.
template <class Real>
Real volume_potential(Real ratio, Real kappa) {
    const Real u = ratio - Real(1), square = u * u;
    const Real s = -larger(Real(-4) * square, Real(-1));
    const Real bounded = s * (Real(3) - Real(3) * s + s * s) / Real(24);
    return select(kappa < Real(0), bounded, Real(0.5f) * square);
}

/// kappa phi'(J - 1) [Pa].
template <class Real>
Real volume_stress(Real ratio, Real kappa) {
    const Real u = ratio - Real(1);
    const Real left = larger(Real(1) - Real(4) * u * u, Real(0));
    return kappa * u * select(kappa < Real(0), left * left, Real(1));
}

/// A tet's part of the volume term, as seen from one of its corners. With p the mean of volume_stress at its
/// corners and J_0 its own J, both at the last evaluation, and k the mean |kappa| of its corners, the term is
/// at most
///   W = V (p (J - J_0) + k / 2 (J - J_0)^2)
/// plus its value then.
template <class Real>
struct VolumeBound {
    Real offset;   ///< V (p - k J_0) [J]
    Real modulus;  ///< V k [J]

    VolumeBound() : offset(Real(0)), modulus(Real(0)) {}
    VolumeBound(Real at_zero, Real slope) : offset(at_zero), modulus(slope) {}
};

/// W, up to a constant [J].
template <class Real>
Real volume_bound_energy(Real ratio, const VolumeBound<Real>& bound) {
    return multiply_add(Real(0.5f) * bound.modulus, ratio, bound.offset) * ratio;
}

/// @param slope, ratio as in add_flat_tet; or of another measure of the volume, of which the bound is, too
template <class Real, class Hessian>
void add_tet_volume(const Vec3<Real>& slope, Real ratio, const VolumeBound<Real>& bound,
                    NodeTerms<Real, Hessian>& terms) {
    const Real pressure = multiply_add(bound.modulus, ratio, bound.offset);
    terms.force = multiply_add(-pressure, slope, terms.force);
    terms.hessian.add_outer(bound.modulus, slope);
}
