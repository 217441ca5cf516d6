#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gelatin {

struct MergedPoints {
    std::vector<std::uint32_t> into;  ///< of each point, the first that it coincides with, or itself
    std::size_t count = 0;            ///< of points that are merged into others
};

/// @param tolerance of the diagonal of the box round all points: those that are so near to one another
/// coincide
MergedPoints merge_points(const std::vector<glm::dvec3>& points, double tolerance);

}  // namespace gelatin
