#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace gelatin {

/// The rotation by `degrees` about x, then y, then z (the scene file's `rotation`).
glm::dquat rotation_from_degrees(const glm::dvec3& degrees);

}  // namespace gelatin
