#include "model/transform.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "mesh/file_ending.h"

namespace gelatin {
namespace {

// Makes `up` the y axis.
glm::dquat to_y(Axis up) {
    if (up == Axis::y) return {1.0, 0.0, 0.0, 0.0};
    return rotation_from_degrees(up == Axis::x ? glm::dvec3(0.0, 0.0, 90.0) : glm::dvec3(-90.0, 0.0, 0.0));
}

Axis own_up(const Shape& shape, Axis scene_up) {
    if (const auto* file = std::get_if<FileShape>(&shape)) {
        const std::string ending = lower_case_ending(file->file);
        return ending == ".gltf" || ending == ".glb" ? Axis::y : scene_up;
    }
    const bool is_in_scene_axes =
        std::holds_alternative<BoxShape>(shape) || std::holds_alternative<MeshShape>(shape);
    return is_in_scene_axes ? scene_up : Axis::y;
}

}  // namespace

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

glm::dquat upright(Axis from, Axis to) {
    return from == to ? glm::dquat(1.0, 0.0, 0.0, 0.0) : glm::conjugate(to_y(to)) * to_y(from);
}

glm::dquat orientation_of(const ObjectDescription& object, Axis scene_up) {
    return rotation_from_degrees(object.rotation) *
           upright(object.up.value_or(own_up(object.shape, scene_up)), scene_up);
}

glm::dquat orientation_of(const ColliderDescription& collider, Axis scene_up) {
    const auto* shape = std::get_if<Shape>(&collider.shape);
    const Axis up = shape == nullptr ? scene_up : collider.up.value_or(own_up(*shape, scene_up));
    return rotation_from_degrees(collider.rotation) * upright(up, scene_up);
}

}  // namespace gelatin
