#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "gelatin/scene.h"

namespace gelatin {

/// The rotation by `degrees` about x, then y, then z (the scene file's `rotation`).
glm::dquat rotation_from_degrees(const glm::dvec3& degrees);

/// Such angles [degrees] of a unit quaternion: from -180 to 180, about y from -90 to 90.
glm::dvec3 degrees_from_rotation(const glm::dquat& rotation);

/// The rotation that makes one axis the up axis: of y and z about x, of x and y about z, by 90 degrees.
glm::dquat upright(Axis from, Axis to);

/// How an object or a collider stands in a scene with this up axis: its shape upright, then its rotation.
glm::dquat orientation_of(const ObjectDescription& object, Axis scene_up);
glm::dquat orientation_of(const ColliderDescription& collider, Axis scene_up);

}  // namespace gelatin
