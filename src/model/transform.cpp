#include "model/transform.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace gelatin {

glm::dquat rotation_from_degrees(const glm::dvec3& degrees) {
    const glm::dvec3 angle = glm::radians(degrees);
    return glm::angleAxis(angle.z, glm::dvec3(0, 0, 1)) * glm::angleAxis(angle.y, glm::dvec3(0, 1, 0)) *
           glm::angleAxis(angle.x, glm::dvec3(1, 0, 0));
}

// For the matrix Rz Ry Rx, m[column][row]. At a right angle about y only the sum of the other two is
// determined.
glm::dvec3 degrees_from_rotation(const glm::dquat& rotation) {
    const glm::dmat3 m = glm::mat3_cast(rotation);
    const double y = std::asin(std::clamp(-m[0][2], -1.0, 1.0));
    const bool is_right_angle = std::abs(m[0][2]) > 1.0 - 1e-12;
    const double x = is_right_angle ? std::atan2(-m[2][1], m[1][1]) : std::atan2(m[1][2], m[2][2]);
    const double z = is_right_angle ? 0.0 : std::atan2(m[0][1], m[0][0]);
    return glm::degrees(glm::dvec3(x, y, z));
}

}  // namespace gelatin
