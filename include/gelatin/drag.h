#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace gelatin {

/// A user's change to the nodes of a pin or a handle, relative to where the scene places them: a rotation
/// about the handle's pivot (for a pin the centre of its nodes), then a displacement.
struct Drag {
    glm::dvec3 move{0.0};                 ///< displacement [m]
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< rotation, a unit quaternion

    bool operator==(const Drag&) const = default;
};

/// The nodes that a pin or a handle of the scene holds, and their present placement.
struct HeldNodes {
    std::size_t object = 0;    ///< index in Scene::objects
    bool is_pin = false;       ///< otherwise a handle
    std::size_t index = 0;     ///< in ObjectDescription::pins or handles
    std::size_t count = 0;     ///< number of nodes; 0 for a pin whose nodes other pins hold as well
    bool is_released = false;  ///< permanently: the handle has released its nodes
    glm::dvec3 center{0.0};    ///< centre of the nodes [m]
    glm::dvec3 pivot{0.0};     ///< point about which they rotate [m]
    Drag drag;                 ///< the present drag
    Drag target;               ///< the drag that they approach
};

}  // namespace gelatin
