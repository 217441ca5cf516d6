#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace gelatin {

/// The angle between two faces of a tet that is the farthest from a right angle, by its sine; negative if the
/// tet is inverted. An angle of 8 degrees and one of 172 count the same.
double worst_sine(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// The six angles between the faces of a tet [radians].
std::array<double, 6> dihedral_angles(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                      const glm::dvec3& d);

/// Three times the radius of the inscribed sphere, by that of the circumscribed one: 1 for a regular tet, 0
/// for a flat one.
double radius_ratio(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

}  // namespace gelatin
