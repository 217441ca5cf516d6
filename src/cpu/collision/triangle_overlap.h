#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <type_traits>
#include <utility>

#include "cpu/nodes.h"
#include "model/shared_constants.h"

namespace gelatin::cpu {

/// The corners of a triangle [m].
template <class Real>
using Triangle = std::array<Vec3<Real>, 3>;

namespace overlap {

// The rounding bound of all signs below. A product of three differences in a determinant w . (u x v) carries
// the errors of the differences, of two multiplications and of three additions, so with r = epsilon / 2
//     |error| <= ((1 + r)^8 - 1) permanent < 9 r permanent,
// where the permanent sums the products' magnitudes and the ninth r pays for its own rounding (a component of
// u x v has half of that): Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", 1997. Taken nearly twice as large, 16 r, so that a determinant whose sign is certain in float
// is at least 7 r of float, which double is always certain of: float is a short cut that cannot change the
// outcome.
template <class Real>
constexpr Real kRoundingBound = predicates::kOverlapRounding* std::numeric_limits<Real>::epsilon();

// Added to the factors of a permanent it pays for products that underflow, even where they are flushed to
// zero.
template <class Real>
constexpr Real kUnderflowBound =
    predicates::kUnderflowRounding* std::numeric_limits<Real>::min() / std::numeric_limits<Real>::epsilon();

/// The sign of `value`, or 0 if rounding may have determined it or it has overflowed; `size` is the
/// permanent.
template <class Real>
int certain_sign(Real value, Real size) {
    const Real bound = kRoundingBound<Real> * size;
    return int{value > bound} - int{value < -bound};
}

// Not glm::abs, which GCC does not inline.
template <class Real>
Vec3<Real> magnitudes(const Vec3<Real>& v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// u x v, and the same with the products' magnitudes added.
template <class Real>
struct Cross {
    Vec3<Real> value, size;

    Cross(const Vec3<Real>& u, const Vec3<Real>& v) {
        const Vec3<Real> plus(u.y * v.z, u.z * v.x, u.x * v.y), minus(u.z * v.y, u.x * v.z, u.y * v.x);
        value = plus - minus;
        size = magnitudes(plus) + magnitudes(minus) + kUnderflowBound<Real>;
    }
    /// The sign of w . (u x v).
    int dot_sign(const Vec3<Real>& w) const {
        const Vec3<Real> a = w * value, b = magnitudes(w) * size;
        return certain_sign((a.x + a.y) + a.z, (b.x + b.y) + b.z + kUnderflowBound<Real>);
    }
    /// The signs of its components.
    glm::ivec3 signs() const {
        return {certain_sign(value.x, size.x), certain_sign(value.y, size.y), certain_sign(value.z, size.z)};
    }
};

template <class Real>
Cross<Real> normal_of(const Triangle<Real>& t) {
    return {t[1] - t[0], t[2] - t[0]};
}

/// The orientation in which the line of edge i of s passes edge j of t, as a sign; 0 if both are in one
/// plane.
template <class Real>
int edge_orientation(const Triangle<Real>& s, int i, const Triangle<Real>& t, int j) {
    return Cross<Real>(s[(i + 1) % 3] - s[i], t[(j + 1) % 3] - t[j]).dot_sign(t[j] - s[i]);
}

/// The signs that determine how two triangles lie, one bit each: i is the side of t's plane on which vertex i
/// of s is, 3 + j the side of s's plane for vertex j of t, 6 + 3 i + j the orientation of edge i of s and
/// edge j of t.
struct Signs {
    std::uint32_t positive = 0, negative = 0;

    void set(int bit, int sign) {
        positive |= std::uint32_t{sign > 0} << bit;
        negative |= std::uint32_t{sign < 0} << bit;
    }
    std::uint32_t zero() const { return 0x7fffu & ~(positive | negative); }
    bool all_alike(std::uint32_t bits) const {
        return (positive & bits) == bits || (negative & bits) == bits;
    }
    bool mixed(std::uint32_t bits) const { return (positive & bits) != 0 && (negative & bits) != 0; }
};
inline constexpr std::uint32_t kVerticesOfS = 0b000'111u, kVerticesOfT = 0b111'000u;
inline constexpr std::uint32_t kEdgeOfS = 0b000'000'111'000'000u,
                               kEdgeOfT = 0b001'001'001'000'000u;  // the first ones

inline int sign_in_double(int bit, const Triangle<double>& s, const Triangle<double>& t) {
    if (bit < 3) return normal_of(t).dot_sign(s[bit] - t[0]);
    if (bit < 6) return normal_of(s).dot_sign(t[bit - 3] - s[0]);
    return edge_orientation(s, (bit - 6) / 3, t, (bit - 6) % 3);
}

/// True if in one of the projections along the axes p, q and r are on one side of line ab and c is not on
/// that side.
inline bool line_separates(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p,
                           const glm::dvec3& q, const glm::dvec3& r) {
    const auto side = [&](const glm::dvec3& x) { return Cross<double>(b - a, x - a).signs(); };
    const glm::ivec3 one = side(p), two = side(q), three = side(r), own = side(c);
    for (int axis = 0; axis < 3; ++axis) {
        const int sign = one[axis];
        if (sign != 0 && two[axis] == sign && three[axis] == sign && own[axis] != sign) return true;
    }
    return false;
}

/// True if edge i of s certainly misses t because their boxes or their projections along an axis do. For an
/// edge in the plane of t this is the whole answer: some projection is faithful, there the line of an edge
/// separates what is apart, and on one line the boxes do.
inline bool misses_in_projection(const Triangle<double>& s, int i, const Triangle<double>& t) {
    const glm::dvec3 &p = s[i], &q = s[(i + 1) % 3], &a = t[0], &b = t[1], &c = t[2];
    return glm::any(glm::lessThan(glm::max(p, q), glm::min(glm::min(a, b), c))) ||
           glm::any(glm::lessThan(glm::max(glm::max(a, b), c), glm::min(p, q))) ||
           line_separates(p, q, p, a, b, c) || line_separates(a, b, c, p, q, q) ||
           line_separates(b, c, a, p, q, q) || line_separates(c, a, b, p, q, q);
}

template <class Real>
bool comes_before(const Vec3<Real>& a, const Vec3<Real>& b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

/// The same triangle for any order of its vertices, so that rounding is the same too.
template <class Real>
Triangle<Real> sorted(Triangle<Real> t) {
    if (comes_before(t[1], t[0])) std::swap(t[0], t[1]);
    if (comes_before(t[2], t[1])) std::swap(t[1], t[2]);
    if (comes_before(t[1], t[0])) std::swap(t[0], t[1]);
    return t;
}

template <class Real>
bool is_finite(const Triangle<Real>& t) {
    const Vec3<Real> zero = t[0] * Real(0) + t[1] * Real(0) + t[2] * Real(0);  // or NaN
    return zero.x + zero.y + zero.z == Real(0);
}

template <class Real>
Triangle<double> to_double(const Triangle<Real>& t) {
    return {glm::dvec3(t[0]), glm::dvec3(t[1]), glm::dvec3(t[2])};
}

/// triangles_overlap for triangles that are sorted and finite.
template <class Real>
bool sorted_triangles_overlap(const Triangle<Real>& s, const Triangle<Real>& t) {
    Signs signs;
    const Cross<Real> normal_of_t = normal_of(t);
    for (int i = 0; i < 3; ++i) signs.set(i, normal_of_t.dot_sign(s[i] - t[0]));
    if (signs.all_alike(kVerticesOfS)) return false;
    const Cross<Real> normal_of_s = normal_of(s);
    for (int j = 0; j < 3; ++j) signs.set(3 + j, normal_of_s.dot_sign(t[j] - s[0]));
    if (signs.all_alike(kVerticesOfT)) return false;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) signs.set(6 + 3 * i + j, edge_orientation(s, i, t, j));
    }
    if constexpr (std::is_same_v<Real, float>) {
        for (std::uint32_t rest = signs.zero(); rest != 0; rest &= rest - 1) {
            const int bit = std::countr_zero(rest);
            signs.set(bit, sign_in_double(bit, to_double(s), to_double(t)));
        }
    }
    const auto edge_meets = [&](std::uint32_t ends, std::uint32_t orientations, const Triangle<Real>& own,
                                int i, const Triangle<Real>& other) {
        if (signs.all_alike(ends) || signs.mixed(orientations)) return false;
        const bool is_certain = (signs.zero() & (ends | orientations)) == 0;
        return is_certain || !misses_in_projection(to_double(own), i, to_double(other));
    };
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t ends = 1u << i | 1u << (i + 1) % 3;
        if (edge_meets(ends, kEdgeOfS << 3 * i, s, i, t)) return true;
        if (edge_meets(ends << 3, kEdgeOfT << i, t, i, s)) return true;
    }
    return false;
}

}  // namespace overlap

/// True if the closed triangles have a point in common: they cross, touch, or overlap in one plane. A
/// triangle without area is the segment or the point that it covers.
///
/// Two triangles meet if and only if an edge of one meets the other. Edge pq misses triangle abc if p and q
/// are on one side of its plane, or if line pq passes two edges in opposite orientations: 15 signs of
/// determinants, as in Segura and Feito, "Algorithms to test ray-triangle intersection", WSCG 2001, with the
/// planes first as in Guigue and Devillers, "Fast and robust triangle-triangle overlap test using orientation
/// predicates", Journal of Graphics Tools 8(1), 2003. If a sign is zero, projections along the axes may still
/// decide.
///
/// False only if that is proven: a sign that is not certain in float is computed in double, and what is not
/// certain there counts as zero, which separates nothing. So no overlap is missed. Triangles may count as
/// touching if their distance is lost in double's rounding: about 1e-14 of their extent, for slivers up to
/// its root, 4e-8. The order of the triangles and of their vertices changes nothing. Coordinates are 0 or of
/// 1e-30 to 1e30 in magnitude; infinities and NaN overlap nothing. GLSL twin:
/// shaders/sim/collision/triangle_overlap.glsl.
template <class Real>
bool triangles_overlap(const Triangle<Real>& s, const Triangle<Real>& t) {
    return overlap::is_finite(s) && overlap::is_finite(t) &&
           overlap::sorted_triangles_overlap(overlap::sorted(s), overlap::sorted(t));
}

}  // namespace gelatin::cpu
