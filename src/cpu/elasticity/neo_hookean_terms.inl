// The terms of neo-Hookean tets in block descent, for any scalar; included as node_terms.inl is. Mat3<Real>
// has columns, sums and products with vectors.

/// The shear and volumetric moduli of a tet, times its volume at rest V [J].
template <class Real>
struct TetModuli {
    Real mu, lambda;
};

/// What the elastic energy of a tet depends on as a function of one corner, with g the corner's shape
/// gradient.
template <class Real>
struct TetAtCorner {
    Vec3<Real> stretched;   ///< F g
    Vec3<Real> slope;       ///< cof F g, the gradient of J [1/m]
    Real squares;           ///< I = F : F
    Real ratio;             ///< J = det F
    Real gradient_squared;  ///< |g|^2 [1/m^2]
};

/// The elastic energy as a function of one corner, with s = cof F g the gradient of J:
///   force   -V (mu I / (I + 1) F g + (lambda (J - 1) - 3/4 mu) s)
///   hessian V (mu I / (I + 1) |g|^2 + 2 mu / (I + 1)^2 (F g) (F g)^T + lambda s s^T),
/// which is exact, because J is linear in one corner, and positive semi-definite for any F.
/// @param bound of the tet's part of the volume term, which is added as in add_tet_volume
template <class Real>
void add_neo_hookean(const TetAtCorner<Real>& tet, const TetModuli<Real>& moduli,
                     const VolumeBound<Real>& bound, NodeTerms<Real>& terms) {
    const Real over = Real(1) / (tet.squares + Real(1));
    const Real shear = moduli.mu * tet.squares * over;
    const Real bulk = moduli.lambda + bound.modulus;
    const Real pressure =
        multiply_add(bulk, tet.ratio, bound.offset - moduli.lambda - Real(0.75f) * moduli.mu);
    terms.force -= shear * tet.stretched + pressure * tet.slope;
    terms.hessian.add_identity(shear * tet.gradient_squared);
    terms.hessian.add_outer(Real(2) * moduli.mu * over * over, tet.stretched);
    terms.hessian.add_outer(bulk, tet.slope);
}

/// m^T v
template <class Matrix, class Vector>
Vector transposed_times(const Matrix& m, const Vector& v) {
    return Vector(dot(m[0], v), dot(m[1], v), dot(m[2], v));
}

/// The viscosity over a step that changes the gradient from `start` to `f`: the dissipation
///   V t a / (2 h) dE : C : dE,   dE = (F^T F - start^T start) / 2,
/// with C the stiffness of viscous_stress, and a the viscous share at the start. The part of the Hessian that
/// is negative where the tet gets shorter is omitted. @param damping t / h
template <class Real>
void add_viscosity(const Vec3<Real>& g, const Mat3<Real>& f, const Mat3<Real>& start,
                   const TetModuli<Real>& moduli, Real damping, NodeTerms<Real>& terms) {
    const Real start_squares = dot(start[0], start[0]) + dot(start[1], start[1]) + dot(start[2], start[2]);
    const Real scale = damping * Real(4) / (start_squares + Real(1));
    const Real shear = Real(0.75f) * moduli.mu, dilation = moduli.lambda - Real(0.625f) * moduli.mu;
    const Mat3<Real> middle = Real(0.5f) * (f + start), change = f - start;
    const Real trace = dot(middle[0], change[0]) + dot(middle[1], change[1]) + dot(middle[2], change[2]);
    const Vec3<Real> twice_strain =
        transposed_times(middle, change * g) + transposed_times(change, middle * g);
    const Vec3<Real> stress = shear * twice_strain + dilation * trace * g;
    terms.force -= scale * (f * stress);
    const Real resistance = scale * shear * dot(g, g);
    for (int k = 0; k < 3; ++k) terms.hessian.add_outer(resistance, f[k]);
    terms.hessian.add_outer(scale * (shear + dilation), f * g);
    const Real across = dot(g, stress);
    terms.hessian.add_identity(scale * select(across > Real(0), across, Real(0)));
}
