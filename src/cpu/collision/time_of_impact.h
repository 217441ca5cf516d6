#pragma once

#include <array>
#include <glm/common.hpp>
#include <limits>
#include <optional>

#include "cpu/collision/nearest_points.h"
#include "cpu/nodes.h"
#include "model/shared_constants.h"

namespace gelatin::cpu {

/// Corners that move along straight lines from `start` to `end` in a step [m], and all points between them:
/// one is a node, two are an edge, three a face.
template <class Real, std::size_t N>
struct Moving {
    std::array<Vec3<Real>, N> start, end;

    std::array<Vec3<Real>, N> at(Real time) const {
        std::array<Vec3<Real>, N> points;
        for (std::size_t k = 0; k < N; ++k) points[k] = start[k] + time * (end[k] - start[k]);
        return points;
    }
};

namespace impact {

// The rounding bound of a gap. With r = epsilon / 2 and the size |n| . reach, where reach bounds the
// coordinates: a coordinate has an error of r, its product another and the sums two more, so that a
// projection is off by less than 4 r size (1 + 2 r). A gap is the difference of two of them, 8 r size,
// rounded by at most 2 r size, and subtracting the bound adds 2 r size. That is 12 r size, and the bound is
// 16 r size.
template <class Real>
constexpr Real kRoundingBound = predicates::kImpactRounding* std::numeric_limits<Real>::epsilon();

// Added to the size, it covers products that underflow, even if they are flushed to zero.
template <class Real>
constexpr Real kUnderflowBound =
    predicates::kUnderflowRounding* std::numeric_limits<Real>::min() / std::numeric_limits<Real>::epsilon();

// The root of a linear function with ends of different signs is a quotient of sums without cancellation: off
// by less than two roundings on the CPU, four in GLSL, which divides to within 2.5 units.
template <class Real>
constexpr Real kRootBound = predicates::kRootRounding* std::numeric_limits<Real>::epsilon();

/// Two or three planes are usually enough. Faces that come so near to touching that these are not enough, or
/// rotate so fast, count as touching.
inline constexpr int kMostPlanes = predicates::kMostPlanes;

/// Times of a step, from 0 at its start to 1 at its end; none if first > last.
template <class Real>
struct Window {
    Real first = 0, last = 1;
};

/// The time during which a plane across `normal`, at any offset, certainly separates a and b, with b on its
/// upper side. The gap of two corners along the normal is linear in time: it is positive between its ends, or
/// from one of them to its root.
/// @param reach bound of the coordinates' magnitudes
template <class Real, std::size_t N, std::size_t M>
Window<Real> separating_window(const Moving<Real, N>& a, const Moving<Real, M>& b, const Vec3<Real>& normal,
                               const Vec3<Real>& reach) {
    const Real bound = kRoundingBound<Real> * (glm::dot(glm::abs(normal), reach) + kUnderflowBound<Real>);
    std::array<Real, M> top_start, top_end;
    for (std::size_t j = 0; j < M; ++j) {
        top_start[j] = glm::dot(normal, b.start[j]);
        top_end[j] = glm::dot(normal, b.end[j]);
    }
    Window<Real> window;
    for (std::size_t i = 0; i < N; ++i) {
        const Real low_start = glm::dot(normal, a.start[i]), low_end = glm::dot(normal, a.end[i]);
        for (std::size_t j = 0; j < M; ++j) {
            const Real start = (top_start[j] - low_start) - bound, end = (top_end[j] - low_end) - bound;
            if (start > Real(0) && end > Real(0)) continue;
            const Real root = start / (start - end);
            if (start > Real(0)) {
                window.last = std::min(window.last, root * (Real(1) - kRootBound<Real>));
            } else if (end > Real(0)) {
                window.first = std::max(window.first, root * (Real(1) + kRootBound<Real>));
            } else {
                return {Real(1), Real(0)};
            }
        }
    }
    return window;
}

template <class Real>
Vec3<Real> shortest_between(const std::array<Vec3<Real>, 1>& node, const std::array<Vec3<Real>, 3>& face) {
    return nearest_points(node[0], face).apart;
}
template <class Real>
Vec3<Real> shortest_between(const std::array<Vec3<Real>, 2>& edge, const std::array<Vec3<Real>, 2>& other) {
    return nearest_points(edge, other).apart;
}
using cpu::shortest_between;  // of faces

/// Positions relative to a's first corner, which moves along, so that only relative motion counts. Returns
/// the largest magnitudes of coordinates.
template <class Real, std::size_t N, std::size_t M>
Vec3<Real> make_relative(Moving<Real, N>& a, Moving<Real, M>& b) {
    const Vec3<Real> start = a.start[0], end = a.end[0];
    Vec3<Real> reach(0);
    const auto shift = [&reach](auto& points, const Vec3<Real>& origin) {
        for (Vec3<Real>& p : points) {
            p -= origin;
            reach = glm::max(reach, glm::abs(p));
        }
    };
    shift(a.start, start);
    shift(b.start, start);
    shift(a.end, end);
    shift(b.end, end);
    return reach;
}

}  // namespace impact

/// The time at which a and b first touch in a step, from 0 at its start to 1 at its end, if each corner moves
/// along a straight line; empty if they do not touch. For a node and a face, two edges, or two faces.
///
/// Conservative advancement with planes. Mirtich ("Impulse-based dynamic simulation of rigid body systems",
/// 1996) advances by bounds on speed along the line between nearest points; along a fixed normal, straight
/// motion needs no bound. The plane perpendicular to the line between the nearest points separates a and b
/// until two corners meet along its normal. From that time on another plane is searched for, and so on. If
/// there is none, or if kMostPlanes do not reach the end of the step, a and b touch.
///
/// They are apart only if that is proven: the rounding bound is subtracted from gaps, and the proof does not
/// depend on the accuracy of the nearest points. So no impact is missed, and the time is not late. False
/// positives need a and b to be near: in float within about 1e-6 of their extent, for pairs whose normals are
/// ill-conditioned (kParallel) 1e-3. Only pairs that turn over or stretch to several times their size within
/// the step may be farther apart, because each plane is valid for a short time. Measured in
/// docs/collision.md. Extents from 1e-9 to 1e9 m; what is not finite touches. GLSL twin:
/// shaders/sim/collision/time_of_impact.glsl.
template <class Real, std::size_t N, std::size_t M>
std::optional<Real> time_of_impact(Moving<Real, N> a, Moving<Real, M> b) {
    const Vec3<Real> reach = impact::make_relative(a, b);
    Real time = 0;
    for (int plane = 0; plane < impact::kMostPlanes; ++plane) {
        const Vec3<Real> normal = impact::shortest_between(a.at(time), b.at(time));
        const impact::Window<Real> window = impact::separating_window(a, b, normal, reach);
        if (!(window.first <= time && time < window.last)) return time;
        if (window.last == Real(1)) return std::nullopt;
        time = window.last;
    }
    return time;
}

}  // namespace gelatin::cpu
