// Stable neo-Hookean tets (Smith, de Goes, Kim: "Stable Neo-Hookean Flesh Simulation", ACM Transactions on
// Graphics 37(2), 2018); see elements.inl. With F the deformation gradient, I = F : F, J = det F, the energy
// over the volume at rest V is
//   W / V = mu/2 (I - 3 - log((I + 1) / 4)) - 3/4 mu (J - 1) + lambda/2 (J - 1)^2,
// their eq. 14 except for a constant that makes it zero at rest. It is defined for flat and inverted tets,
// and the rest shape is its only minimum. GLSL twin: shaders/sim/elasticity/neo_hookean.glsl.

/// The shear and volumetric moduli of a tet [Pa], or times its volume at rest V [J].
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

/// a : b.
template <class Matrix>
auto double_dot(const Matrix& a, const Matrix& b) {
    return dot(a[0], b[0]) + dot(a[1], b[1]) + dot(a[2], b[2]);
}

/// dJ/dF.
template <class Real>
Mat3<Real> cofactor(const Mat3<Real>& f) {
    return Mat3<Real>(cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1]));
}

/// @param g the corner's shape gradient
template <class Real>
TetAtCorner<Real> tet_at_corner(const Vec3<Real>& g, const Mat3<Real>& f) {
    const Mat3<Real> cofactors = cofactor<Real>(f);
    return {f * g, cofactors * g, double_dot(f, f), dot(f[0], cofactors[0]), dot(g, g)};
}

/// W [J]. @param moduli times V
template <class Real>
Real neo_hookean_energy(const Mat3<Real>& f, const TetModuli<Real>& moduli) {
    const Real squares = double_dot(f, f), dilation = dot(f[0], cross(f[1], f[2])) - Real(1);
    return Real(0.5) * moduli.mu * (squares - Real(3) - logarithm(Real(0.25) * (squares + Real(1)))) +
           (Real(0.5) * moduli.lambda * dilation - Real(0.75) * moduli.mu) * dilation;
}

/// The two factors of the stress dW/dF / V = shear F + pressure cof F [Pa].
template <class Real>
struct NeoHookeanStress {
    Real shear;     ///< mu I / (I + 1)
    Real pressure;  ///< lambda (J - 1) - 3/4 mu
};

/// @param inverse 1 / (I + 1)
template <class Real>
NeoHookeanStress<Real> neo_hookean_stress(Real squares, Real inverse, Real ratio,
                                          const TetModuli<Real>& moduli) {
    return {moduli.mu * squares * inverse,
            multiply_add(moduli.lambda, ratio - Real(1), Real(-0.75f) * moduli.mu)};
}

/// The force on the corner: -V (shear F g + pressure cof F g). @param moduli times V
template <class Real>
Vec3<Real> neo_hookean_force(const TetAtCorner<Real>& tet, const TetModuli<Real>& moduli) {
    const Real inverse = Real(1) / (tet.squares + Real(1));
    const NeoHookeanStress<Real> stress = neo_hookean_stress(tet.squares, inverse, tet.ratio, moduli);
    return -stress.shear * tet.stretched - stress.pressure * tet.slope;
}

/// The force on the corner that opens a collapsed tet: V mu g. @param stiffness V mu [J]
template <class Real>
Vec3<Real> opening_force(const Vec3<Real>& g, Real squares, Real stiffness) {
    return select(squares < Real(static_cast<float>(kCollapsed)), stiffness, Real(0)) * g;
}

/// m^T v
template <class Matrix, class Vector>
Vector transposed_times(const Matrix& m, const Vector& v) {
    return Vector(dot(m[0], v), dot(m[1], v), dot(m[2], v));
}

/// S g, with the viscous stress S = 2 mu_L E + lambda_L tr E by Lamé's moduli mu_L = 3/4 mu, lambda_L =
/// lambda - 5/8 mu, and E = sym(F^T D) the change of Green's strain as F changes by D, or its rate. Rotation
/// has none, so it is not damped.
template <class Real>
Vec3<Real> viscous_traction(const Vec3<Real>& g, const Mat3<Real>& f, const Mat3<Real>& change,
                            const TetModuli<Real>& moduli) {
    const Real shear = Real(0.75f) * moduli.mu;
    const Real dilation = multiply_add(Real(-0.625f), moduli.mu, moduli.lambda) * double_dot(f, change);
    const Vec3<Real> twice_strain = transposed_times(f, change * g) + transposed_times(change, f * g);
    return shear * twice_strain + dilation * g;
}

/// The factor a on the damping of a stretched tet: 4 / (I + 1), 1 at rest. F S grows with the square of F,
/// elastic stress with F. Without it a relaxation that takes t at rest would take forever in a tet that is
/// stretched far.
template <class Real>
Real viscous_share(Real squares) {
    return Real(4) / (squares + Real(1));
}

/// The force of viscosity on the corner: -V t a F S g with the damping time t. @param moduli times V
template <class Real>
Vec3<Real> viscous_force(const Vec3<Real>& g, const Mat3<Real>& f, const Mat3<Real>& rate,
                         const TetModuli<Real>& moduli, Real damping_time) {
    const Real scale = -damping_time * viscous_share(double_dot(f, f));
    return scale * (f * viscous_traction<Real>(g, f, rate, moduli));
}
