#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin {

/// True if `point` is in the region, its boundary included.
bool holds(const Region& region, const glm::dvec3& point);

/// True if `point` is in one of the regions.
bool any_holds(const std::vector<Region>& regions, const glm::dvec3& point);

/// The indices of the points in the region, ascending.
std::vector<std::uint32_t> find_inside(const Region& region, const std::vector<glm::dvec3>& points);

}  // namespace gelatin
