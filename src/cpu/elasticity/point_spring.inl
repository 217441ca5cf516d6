// Springs without rest length that hold a node to a point; see elements.inl. Inertia is one, with the
// stiffness m / h^2, to where the node would go by itself; a hand's pull is another (cpu/drive/pulls.h).

template <class Real>
struct PointSpring {
    Vec3<Real> place;  ///< p [m]
    Real stiffness;    ///< k [N/m]
};

/// Over a step of h seconds, the damper k t / (2 h) |x - x_0|^2, with x_0 where the node was when the step
/// began, makes of a point spring another one: of stiffness K = k (1 + t / h), to P = (p + t / h x_0) / (1 +
/// t / h).
/// @param damping t / h
template <class Real>
PointSpring<Real> damped_point_spring(const PointSpring<Real>& spring, const Vec3<Real>& start,
                                      Real damping) {
    return {(spring.place + damping * start) / (Real(1) + damping), spring.stiffness * (Real(1) + damping)};
}

/// One that acts like both together; its energy is theirs less a constant. @pre a's stiffness is positive
template <class Real>
PointSpring<Real> both(const PointSpring<Real>& a, const PointSpring<Real>& b) {
    const Real stiffness = a.stiffness + b.stiffness;
    return {(a.stiffness * a.place + b.stiffness * b.place) / stiffness, stiffness};
}
