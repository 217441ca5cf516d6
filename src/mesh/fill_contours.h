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

/// Flips the diagonal of two neighbouring triangles wherever that improves the worse of them, until no flip
/// does (Lawson 1977). This also removes the triangles of zero area that filling makes between collinear
/// points.
void improve_triangles(FlatMesh& mesh);

/// Approximate sine of a triangle's smallest angle: twice its area divided by the square of its longest side.
/// Negative if it is wound clockwise.
double triangle_quality(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

}  // namespace gelatin
