#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace gelatin::lattice {

/// The angle between two faces of a tet that is the farthest from a right angle, by its sine; negative if the tet is inverted.
/// An angle of 8 degrees and one of 172 count the same.
double worst_sine(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// The six angles between the faces of a tet [radians].
std::array<double, 6> dihedral_angles(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                      const glm::dvec3& d);

}  // namespace gelatin::lattice
