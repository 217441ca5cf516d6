#pragma once

#include <glm/vec3.hpp>

namespace gelatin::viewer {

/// A half-line in the world.
struct Ray {
    glm::vec3 origin;     ///< [m]
    glm::vec3 direction;  ///< unit

    glm::vec3 at(float distance) const { return origin + distance * direction; }
};

}  // namespace gelatin::viewer
