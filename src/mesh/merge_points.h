#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gelatin {

struct MergedPoints {
    std::vector<std::uint32_t> into;  ///< for each point, the first point that coincides with it, or itself
    std::size_t count = 0;            ///< number of points that are merged into others
};

/// @param tolerance relative to the diagonal of the bounding box: points that are nearer to each other
///   coincide
MergedPoints merge_points(const std::vector<glm::dvec3>& points, double tolerance);

}  // namespace gelatin
