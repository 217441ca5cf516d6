#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace gelatin::lattice {

/// Triangles that close a surface: with them every edge is used as often in one direction as in the other.
/// Each hole is closed by triangles between its vertices whose size halves from one to the next, so that
/// those near a point are few, whatever the hole's shape.
/// @return empty for a closed surface
std::vector<glm::uvec3> find_caps(std::span<const glm::uvec3> faces);

}  // namespace gelatin::lattice
