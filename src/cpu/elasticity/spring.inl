// Springs and their dampers; see elements.inl. GLSL twin: shaders/sim/elasticity/spring_force.glsl.

/// Squares of lengths count as no less [m^2]: a spring of no length has no direction and no force.
constexpr float kLeastSquare = 1e-30f;

template <class Real>
struct SpringLaw {
    Real rest_length;  ///< L [m]
    Real stiffness;    ///< k [N/m]
};

/// k / 2 (l - L)^2 with the length l = |d| [J]. @param apart the vector d from one end to the other
template <class Real>
Real spring_energy(const Vec3<Real>& apart, const SpringLaw<Real>& spring) {
    const Real longer = square_root(dot(apart, apart)) - spring.rest_length;
    return Real(0.5f) * spring.stiffness * longer * longer;
}

/// 1 / l
template <class Real>
Real inverse_length(const Vec3<Real>& apart) {
    return Real(1) / square_root(larger(dot(apart, apart), Real(kLeastSquare)));
}

/// The force of a spring and its damper on the end that `apart` starts at, as a multiple of d [N/m]: k (l - L
/// + t l') / l with the damping time t [s] and l' the rate of change of l (damping along the spring: Nealen
/// et al. 2006, eq. 5, with k_d = k t).
/// @param rate of change of `apart` [m/s]
template <class Real>
Real spring_pull(const Vec3<Real>& apart, const Vec3<Real>& rate, const SpringLaw<Real>& spring,
                 Real damping_time) {
    const Real squared = larger(dot(apart, apart), Real(kLeastSquare));
    const Real length = square_root(squared), inverse = Real(1) / length;
    const Real longer = multiply_add(damping_time, dot(apart, rate) * inverse, length - spring.rest_length);
    return spring.stiffness * longer * inverse;
}

/// Over a step of h seconds, the damper
///   k t / (2 h) (l - l_0)^2,
/// with l_0 the length at the step's start, makes of a spring another one: of stiffness K = k (1 + t / h) and
/// rest length M = (L + t / h l_0) / (1 + t / h).
/// @param damping t / h
template <class Real>
SpringLaw<Real> damped_spring(const SpringLaw<Real>& spring, Real start_length, Real damping) {
    return {multiply_add(damping, start_length, spring.rest_length) / (Real(1) + damping),
            multiply_add(spring.stiffness, damping, spring.stiffness)};
}
