#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cpu/collision/axis_box.h"

namespace gelatin::cpu {

/// Between two boxes [m^2].
template <class Real>
Real squared_distance(const AxisBox<Real>& a, const AxisBox<Real>& b) {
    const Vec3<Real> apart = glm::max(glm::max(a.min - b.max, b.min - a.max), Vec3<Real>(0));
    return glm::dot(apart, apart);
}

/// The box with less of a margin; it may be inside out then, and is compared all the same.
template <class Real>
AxisBox<Real> trimmed(AxisBox<Real> box, Real margin) {
    box.min += margin;
    box.max -= margin;
    return box;
}

/// What the box passes over on its way.
template <class Real>
AxisBox<Real> swept(AxisBox<Real> box, const Vec3<Real>& motion) {
    if (motion == Vec3<Real>(0)) return box;
    box.min += glm::min(motion, Vec3<Real>(0));
    box.max += glm::max(motion, Vec3<Real>(0));
    return box;
}

}  // namespace gelatin::cpu
