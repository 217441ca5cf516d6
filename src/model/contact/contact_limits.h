#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "model/layouts.h"

namespace gelatin {

/// What an aim of contacts leaves each surface node (docs/contact.md).
struct ContactLimits {
    std::vector<NodeLimits> nodes;  ///< shape [surface nodes]
    std::vector<glm::vec4> planes;  ///< towards the other side, unit; how far the node may go along it [m]
    std::vector<NodeShare> shares;
};

}  // namespace gelatin
