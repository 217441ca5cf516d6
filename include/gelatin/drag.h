#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace gelatin {

/// How far the nodes of a pin or a handle are from where the scene has them at the time: turned about the
/// handle's pivot (a pin's is the centre of its nodes), then moved.
struct Drag {
    glm::dvec3 move{0.0};                 ///< [m]
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< unit

    bool operator==(const Drag&) const = default;
};

/// Nodes that a pin or a handle of the scene holds, as they are now.
struct HeldNodes {
    std::size_t object = 0;    ///< index in Scene::objects
    bool is_pin = false;       ///< else a handle
    std::size_t index = 0;     ///< in ObjectDescription::pins or handles
    std::size_t count = 0;     ///< of nodes; 0 of a pin whose nodes other pins hold, too
    bool is_released = false;  ///< for good: the handle has let go
    glm::dvec3 center{0.0};    ///< of the nodes [m]
    glm::dvec3 pivot{0.0};     ///< about which they turn [m]
    Drag drag;                 ///< where they are
    Drag target;               ///< where they are on their way to
};

}  // namespace gelatin
