// Included for doubles and, once for each instruction set, for lanes of floats.

// The leading minors of sym(R^T F) - part: all are positive if its eigenvalues are.
template <class Real>
struct Minors {
    Real first, second, third;
};

template <class Real>
Minors<Real> minors(const Mat3<Real>& r, const Mat3<Real>& f, Real part) {
    const Real half(0.5f), xx = dot(r[0], f[0]) - part, yy = dot(r[1], f[1]) - part,
                           zz = dot(r[2], f[2]) - part;
    const Real xy = half * (dot(r[0], f[1]) + dot(r[1], f[0])),
               yz = half * (dot(r[1], f[2]) + dot(r[2], f[1])),
               zx = half * (dot(r[2], f[0]) + dot(r[0], f[2]));
    const Real second = xx * yy - xy * xy;
    const Real beside = xx * (yz * yz) + yy * (zx * zx) - Real(2.0f) * (xy * yz * zx);
    return {xx, second, zz * second - beside};
}
