#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace gelatin {

/// A polygon in space as triangles.
struct FilledPolygon {
    std::vector<glm::uvec3> triangles;  ///< indices of corners, wound as the polygon; two fewer than corners
    bool crosses_itself = false;        ///< then triangles overlap or lie outside
};

/// Triangulates a polygon, convex or not, by its outline as seen along its normal: no triangle is outside.
/// @param corners at least three; several may coincide, as where an outline goes into a hole and back
FilledPolygon fill_polygon(const std::vector<glm::dvec3>& corners);

}  // namespace gelatin
