#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// The part of a motion from u, inside a ball round the origin, that stays in it.
template <class Real>
Real part_within(const Vec3<Real>& u, const Vec3<Real>& motion, Real radius) {
    const Vec3<Real> end = u + motion;
    if (glm::dot(end, end) <= radius * radius) return Real(1);
    const Real a = glm::dot(motion, motion), b = glm::dot(u, motion), c = glm::dot(u, u) - radius * radius;
    if (!(c < Real(0)) || !(a > Real(0))) return Real(0);
    const Real root = std::sqrt(b * b - a * c);
    const Real part = b > Real(0) ? -c / (b + root) : (root - b) / a;
    return std::clamp(Real(0.999f) * part, Real(0), Real(1));
}

}  // namespace gelatin::cpu
