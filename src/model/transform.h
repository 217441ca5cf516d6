#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace gelatin {

/// The rotation by `degrees` about x, then y, then z (the scene file's `rotation`).
glm::dquat rotation_from_degrees(const glm::dvec3& degrees);

/// Such angles [degrees] of a unit quaternion: from -180 to 180, about y from -90 to 90.
glm::dvec3 degrees_from_rotation(const glm::dquat& rotation);

}  // namespace gelatin
