// What elements add to a node's part of the objective of a step, for any scalar. cpu/elasticity/node_terms.h
// includes it for double and float, cpu/elasticity/node_terms-inl.h for lanes of floats, once for each
// instruction set. Both provide Vec3<Real> with its operators, and dot, multiply_add and select. Constructors
// are written out: those that compilers make themselves are not compiled for the instruction set.

/// A symmetric matrix [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]].
template <class Real>
struct SymmetricMatrix {
    Vec3<Real> diagonal;  ///< xx, yy, zz
    Vec3<Real> beside;    ///< yz, zx, xy

    SymmetricMatrix() : diagonal(Real(0)), beside(Real(0)) {}
    SymmetricMatrix(const Vec3<Real>& on_diagonal, const Vec3<Real>& off_diagonal)
        : diagonal(on_diagonal), beside(off_diagonal) {}

    void add_identity(Real factor) { diagonal += Vec3<Real>(factor); }
    /// factor v v^T
    void add_outer(Real factor, const Vec3<Real>& v) {
        const Vec3<Real> scaled = factor * v;
        diagonal = multiply_add(scaled, v, diagonal);
        beside = multiply_add(Vec3<Real>(scaled.y, scaled.z, scaled.x), Vec3<Real>(v.z, v.x, v.y), beside);
    }
};

/// The contribution of a body's elements to a node's part of the objective of a step: minus its gradient,
/// which is a force [N], and a positive semi-definite second derivative [N/m]. GLSL twin:
/// shaders/sim/elasticity/node_terms.glsl.
template <class Real>
struct NodeTerms {
    Vec3<Real> force;
    SymmetricMatrix<Real> hessian;

    NodeTerms() : force(Real(0)) {}
    NodeTerms(const Vec3<Real>& own_force, const SymmetricMatrix<Real>& own_hessian)
        : force(own_force), hessian(own_hessian) {}
};

/// A tet as seen from one of its corners, with v its volume, V that at rest, J = v / V, J_0 = kFlattest and K
/// its modulus: W = V K / 2 (J_0 - J)^2 where J < J_0, otherwise 0. v is linear in one corner, so
///   force   V K (J_0 - J) dJ/dx,   hessian V K dJ/dx dJ/dx^T.
/// It moves springs out of mirrored and tangled shapes, in which they would also be at rest.
/// @param slope dJ/dx [1/m] @param ratio J @param stiffness V K [J]
template <class Real>
void add_flat_tet(const Vec3<Real>& slope, Real ratio, Real stiffness, NodeTerms<Real>& terms) {
    const Real lack = Real(kFlattest) - ratio;
    const Real resisting = select(lack > Real(0), stiffness, Real(0));
    terms.force += resisting * lack * slope;
    terms.hessian.add_outer(resisting, slope);
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

/// @param slope, ratio as in add_flat_tet
template <class Real>
void add_tet_volume(const Vec3<Real>& slope, Real ratio, const VolumeBound<Real>& bound,
                    NodeTerms<Real>& terms) {
    terms.force -= multiply_add(bound.modulus, ratio, bound.offset) * slope;
    terms.hessian.add_outer(bound.modulus, slope);
}
