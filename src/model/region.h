#pragma once

#include "gelatin/scene.h"

namespace gelatin {

/// True if the point [m] is in the region or on its boundary.
bool contains(const Region& region, const glm::dvec3& point);

}  // namespace gelatin
