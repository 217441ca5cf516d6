#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh/text_outline.h"

namespace gelatin {

/// A region of the plane as triangles, counter-clockwise.
struct FlatMesh {
    std::vector<glm::dvec2> positions;
    std::vector<glm::uvec3> triangles;
};

/// Fills the inside of `contours`, by the nonzero winding rule, with well-shaped triangles. Where contours
/// cross, points are added.
/// @throws InvalidInput if they cannot be filled.
FlatMesh fill_contours(const std::vector<Contour>& contours);

}  // namespace gelatin
