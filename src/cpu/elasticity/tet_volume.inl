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
