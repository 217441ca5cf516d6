// The nearest points of a node and a face, or of two edges, for any scalar. Without
// branches. As in cpu/collision/nearest_points.h, directions come from normals and from residuals along
// edges, so that they are accurate however short they are; results may differ by rounding from those there.

template <class Real>
Real smaller(Real a, Real b) {
    return Real(0) - larger(Real(0) - a, Real(0) - b);
}

template <class Mask, class Vector3>
Vector3 choose(Mask condition, const Vector3& a, const Vector3& b) {
    return Vector3(select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z));
}

/// Weights of the four nodes, the first side's first, and the vector from the first side to the second [m].
template <class Real>
struct NearestPair {
    Real weight_0, weight_1, weight_2, weight_3;
    Vec3<Real> apart;
    Real squared;  ///< |apart|^2

    NearestPair(Real w0, Real w1, Real w2, Real w3, const Vec3<Real>& between)
        : weight_0(w0),
          weight_1(w1),
          weight_2(w2),
          weight_3(w3),
          apart(between),
          squared(dot(between, between)) {}
};

template <class Mask, class Real>
NearestPair<Real> choose(Mask condition, const NearestPair<Real>& a, const NearestPair<Real>& b) {
    return NearestPair<Real>(select(condition, a.weight_0, b.weight_0),
                             select(condition, a.weight_1, b.weight_1),
                             select(condition, a.weight_2, b.weight_2),
                             select(condition, a.weight_3, b.weight_3), choose(condition, a.apart, b.apart));
}

template <class Real>
NearestPair<Real> nearer(const NearestPair<Real>& a, const NearestPair<Real>& b) {
    return choose(b.squared < a.squared, b, a);
}

/// From a point to an edge from a to b.
template <class Real>
struct ToEdge {
    Real fraction;  ///< of the edge from a, in [0, 1]
    Vec3<Real> apart;

    ToEdge(const Vec3<Real>& p, const Vec3<Real>& a, const Vec3<Real>& b) {
        const Vec3<Real> edge = b - a, start = a - p;
        const Real squared = dot(edge, edge), none(0), one(1);
        const Real inverse = select(squared > none, one / squared, none);
        const Real along = none - dot(start, edge) * inverse;
        fraction = smaller(larger(along, none), one);
        apart = multiply_add(fraction, edge, start);
        const Real is_inner = select(along > none, select(along < one, one, none), none);
        apart = multiply_add(none - is_inner * dot(apart, edge) * inverse, edge, apart);
    }
};

/// Two directions u and v count as parallel if |u x v|^2 is at most this.
template <class Real>
Real parallel_bound(Real squared_u, Real squared_v) {
    return Real(predicates::kParallelRounding) * Real(kEpsilon<Real>) * squared_u * squared_v;
}

/// 1 where a normal of two directions is sound and all of `least` is not negative, else 0.
/// @param size |u x v|^2 @param bound below which u and v are parallel
template <class Real>
Real sound_inside(Real size, Real bound, Real least) {
    return select(size > bound, select(least < Real(0), Real(0), Real(1)), Real(0));
}

template <class Real>
NearestPair<Real> nearest_of_node_and_face(const Vec3<Real>& p, const Vec3<Real>& a, const Vec3<Real>& b,
                                           const Vec3<Real>& c) {
    const Real none(0), one(1);
    const ToEdge<Real> ab(p, a, b), bc(p, b, c), ca(p, c, a);
    const NearestPair<Real> first(one, one - ab.fraction, ab.fraction, none, ab.apart),
        second(one, none, one - bc.fraction, bc.fraction, bc.apart),
        third(one, ca.fraction, none, one - ca.fraction, ca.apart);
    const NearestPair<Real> on_edge = nearer(nearer(first, second), third);

    const Vec3<Real> u = b - a, v = c - a, w = p - a, normal = cross(u, v);
    const Real size = dot(normal, normal), at_b = dot(cross(w, v), normal), at_c = dot(cross(u, w), normal);
    const Real at_a = size - at_b - at_c;
    const Real inside =
        sound_inside(size, parallel_bound(dot(u, u), dot(v, v)), smaller(at_a, smaller(at_b, at_c)));
    const Real inverse = select(inside > none, one / size, none);
    const NearestPair<Real> within(one, at_a * inverse, at_b * inverse, at_c * inverse,
                                   (none - dot(w, normal) * inverse) * normal);
    return choose(inside > none, within, on_edge);
}

template <class Real>
NearestPair<Real> nearest_of_edges(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c,
                                   const Vec3<Real>& d) {
    const Real none(0), one(1);
    const ToEdge<Real> from_a(a, c, d), from_b(b, c, d), from_c(c, a, b), from_d(d, a, b);
    const NearestPair<Real> at_a(one, none, one - from_a.fraction, from_a.fraction, from_a.apart),
        at_b(none, one, one - from_b.fraction, from_b.fraction, from_b.apart),
        at_c(one - from_c.fraction, from_c.fraction, one, none, Vec3<Real>(none) - from_c.apart),
        at_d(one - from_d.fraction, from_d.fraction, none, one, Vec3<Real>(none) - from_d.apart);
    const NearestPair<Real> at_end = nearer(nearer(at_a, at_b), nearer(at_c, at_d));

    const Vec3<Real> u = b - a, v = d - c, w = c - a, normal = cross(u, v);
    const Real size = dot(normal, normal), s = dot(cross(w, v), normal), t = dot(cross(w, u), normal);
    const Real inside = sound_inside(size, parallel_bound(dot(u, u), dot(v, v)),
                                     smaller(smaller(s, size - s), smaller(t, size - t)));
    const Real inverse = select(inside > none, one / size, none);
    const NearestPair<Real> within(one - s * inverse, s * inverse, one - t * inverse, t * inverse,
                                   (dot(w, normal) * inverse) * normal);
    return choose(inside > none, within, at_end);
}

template <class Vector3>
Vector3 larger_of(const Vector3& a, const Vector3& b) {
    return Vector3(larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z));
}

template <class Vector3>
Vector3 magnitude(const Vector3& v) {
    return larger_of(v, Vector3(v - v) - v);
}

/// Bound of what rounding makes of a difference of the nodes' heights along a direction.
/// @param apart along it, as long as `gap`
template <class Real>
Real rounding_along(const Vec3<Real>& apart, Real gap, const Vec3<Real> (&nodes)[4]) {
    const Real none(0);
    Vec3<Real> extent(none), reach = magnitude(nodes[0]);
    for (int k = 1; k < 4; ++k) {
        extent = larger_of(extent, magnitude(nodes[k] - nodes[0]));
        reach = larger_of(reach, magnitude(nodes[k]));
    }
    const Vec3<Real> normal = select(gap > none, Real(1) / gap, none) * apart;
    return Real(kEpsilon<Real>) * dot(magnitude(normal), multiply_add(Real(8), extent, Real(4) * reach));
}
