#include "model/transform.h"

#include <glm/trigonometric.hpp>

namespace gelatin {

glm::dquat rotation_from_degrees(const glm::dvec3& degrees) {
    const glm::dvec3 angle = glm::radians(degrees);
    return glm::angleAxis(angle.z, glm::dvec3(0, 0, 1)) * glm::angleAxis(angle.y, glm::dvec3(0, 1, 0)) *
           glm::angleAxis(angle.x, glm::dvec3(1, 0, 0));
}

}  // namespace gelatin
