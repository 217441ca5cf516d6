#pragma once

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// How much larger boxes are than their content, so that the boxes of things nearer than a distance meet:
/// half of that distance on every side, plus a bound of the rounding error. `slack` is a power of two, whose
/// products are exact.
template <class Real>
struct BoxMargin {
    Real width = 0;  ///< [m]
    Real slack = 0;  ///< relative to the coordinate

    static BoxMargin for_distance(double distance) {
        return {static_cast<Real>(0.5 * distance) * (1 + 8 * std::numeric_limits<Real>::epsilon()),
                2 * std::numeric_limits<Real>::epsilon()};
    }
    Vec3<Real> at(const Vec3<Real>& point) const {
        return slack > Real(0) ? width + slack * glm::abs(point)
                               : Vec3<Real>(width);  // 0 * inf is not a number
    }
};

/// An axis-aligned box. It is empty, and meets nothing, until something is added.
template <class Real>
struct AxisBox {
    Vec3<Real> min{std::numeric_limits<Real>::infinity()};   ///< [m]
    Vec3<Real> max{-std::numeric_limits<Real>::infinity()};  ///< [m]

    void add(const Vec3<Real>& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void add(const Vec3<Real>& point, const BoxMargin<Real>& margin) {
        min = glm::min(min, point - margin.at(point));
        max = glm::max(max, point + margin.at(point));
    }
    void add(const AxisBox& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
    Vec3<Real> center() const { return Real(0.5) * (min + max); }
};

/// True if they share a point: boxes are closed. Without branches, for long loops.
template <class Real>
bool meet(const AxisBox<Real>& a, const AxisBox<Real>& b) {
    return static_cast<bool>((a.min.x <= b.max.x) & (b.min.x <= a.max.x) & (a.min.y <= b.max.y) &
                             (b.min.y <= a.max.y) & (a.min.z <= b.max.z) & (b.min.z <= a.max.z));
}

}  // namespace gelatin::cpu
