#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <vector>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// The least of any along a direction [m].
template <class Real>
Real least_height(std::span<const Vec4<Real>> positions, const Vec3<Real>& direction) {
    Real least = std::numeric_limits<Real>::infinity();
    for (const Vec4<Real>& position : positions)
        least = std::min(least, glm::dot(direction, Vec3<Real>(position)));
    return least;
}

}  // namespace gelatin::cpu
