#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace gelatin::cpu {

/// The least length to which a linear map takes a unit vector, its smallest singular value: by the
/// eigenvalues of m^T m, with cosines (Smith 1961). Never more than it is, but for rounding of the order of
/// its square root where the map is nearly singular.
template <class Real>
Real least_stretch(const glm::mat<3, 3, Real>& m) {
    const glm::mat<3, 3, Real> square = glm::transpose(m) * m;
    const Real mean = (square[0][0] + square[1][1] + square[2][2]) / Real(3);
    const glm::mat<3, 3, Real> rest = square - glm::mat<3, 3, Real>(mean);
    const Real spread = std::sqrt(
        (glm::dot(rest[0], rest[0]) + glm::dot(rest[1], rest[1]) + glm::dot(rest[2], rest[2])) / Real(6));
    Real least = mean;
    if (spread > Real(0)) {
        const Real cosine = glm::determinant(rest / spread) / Real(2);
        constexpr auto kThird = Real(2.0943951023931954923);  // of a turn
        const Real angle = std::acos(std::clamp(cosine, Real(-1), Real(1))) / Real(3);
        least = mean + Real(2) * spread * std::cos(angle + kThird);
    }
    least -= Real(8) * std::numeric_limits<Real>::epsilon() * mean;
    return std::sqrt(std::max(least, Real(0)));
}

}  // namespace gelatin::cpu
