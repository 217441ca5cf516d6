#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gelatin::lattice {

/// Where a lattice point is.
enum class Side : std::uint8_t { inside, boundary, outside };

/// Adds the tets of the part of a tet that is inside. Quadrilaterals on its faces are divided by a rule that
/// depends on the face alone, so that neighbours agree: along the diagonal from the inner node that is nearer
/// to its cut.
/// @param sides of its corners, of which one at least is inside
/// @param cut the node where the edge between an inner and an outer corner is cut
void cut_tet(const std::array<std::uint32_t, 4>& tet, const std::array<Side, 4>& sides,
             const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& cut,
             const std::vector<glm::dvec3>& positions, std::vector<glm::uvec4>& tets);

}  // namespace gelatin::lattice
