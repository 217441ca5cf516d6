// What an element adds to a node; see elements.inl.

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

template <class Real>
Vec3<Real> operator*(const SymmetricMatrix<Real>& m, const Vec3<Real>& v) {
    return m.diagonal * v + Vec3<Real>(m.beside.z * v.y + m.beside.y * v.z,
                                       m.beside.z * v.x + m.beside.x * v.z,
                                       m.beside.y * v.x + m.beside.x * v.y);
}

/// What elements add to a node: a force [N], and how it falls as the node moves, positive semi-definite
/// [N/m]. GLSL twin: shaders/sim/elasticity/node_terms.glsl.
template <class Real>
struct NodeTerms {
    Vec3<Real> force;
    SymmetricMatrix<Real> hessian;

    NodeTerms() : force(Real(0)) {}
};

/// 1 / pivot. Pivots that are smaller than the rounding error of their operands count as no stiffness, and
/// give 0.
template <class Real>
Real inverse_pivot(Real pivot, Real diagonal) {
    const Real sound = larger(pivot, Real(8) * Real(kEpsilon<Real>) * diagonal);
    return select(sound > Real(0), Real(1) / sound, Real(0));
}

/// matrix = L D L^T, the square-root-free Cholesky decomposition; zero along directions without stiffness.
/// Lost pivots may make what is solved by it too short, never too long.
template <class Real>
struct Factors {
    Real i0, i1, i2;     ///< D^-1
    Real l10, l20, l21;  ///< L

    explicit Factors(const SymmetricMatrix<Real>& matrix) {
        const Vec3<Real>&d = matrix.diagonal, &b = matrix.beside;
        i0 = inverse_pivot(d.x, d.x);
        l10 = b.z * i0;
        l20 = b.y * i0;
        i1 = inverse_pivot(multiply_add(-l10, b.z, d.y), d.y);
        const Real rest = multiply_add(-l20, b.z, b.x);
        l21 = rest * i1;
        i2 = inverse_pivot(multiply_add(-l21, rest, multiply_add(-l20, b.y, d.z)), d.z);
    }
};

/// matrix^-1 v
template <class Real>
Vec3<Real> solve(const SymmetricMatrix<Real>& matrix, const Vec3<Real>& v) {
    const Factors<Real> f(matrix);
    const Real y1 = multiply_add(-f.l10, v.x, v.y);
    const Real y2 = multiply_add(-f.l21, y1, multiply_add(-f.l20, v.x, v.z));
    const Real z = y2 * f.i2, y = multiply_add(-f.l21, z, y1 * f.i1);
    return Vec3<Real>(multiply_add(-f.l20, z, multiply_add(-f.l10, y, v.x * f.i0)), y, z);
}

/// matrix^-1
template <class Real>
SymmetricMatrix<Real> inverse_of(const SymmetricMatrix<Real>& matrix) {
    const Factors<Real> f(matrix);
    const Real corner = multiply_add(f.l10, f.l21, -f.l20);  // of L^-1
    const Real scaled = corner * f.i2, beside = f.l21 * f.i2;
    return {Vec3<Real>(multiply_add(corner, scaled, multiply_add(f.l10 * f.l10, f.i1, f.i0)),
                       multiply_add(f.l21, beside, f.i1), f.i2),
            Vec3<Real>(-beside, scaled, -multiply_add(corner, beside, f.l10 * f.i1))};
}
