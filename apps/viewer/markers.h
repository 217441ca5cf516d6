#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera_controller.h"
#include "gelatin/drag.h"
#include "gelatin/scene.h"

namespace gelatin::viewer {

/// The mark of a pin or a handle, at the centre of its nodes in the picture. Positions are
/// CameraController's.
struct Marker {
    std::size_t held = 0;    ///< index in Simulator::held_nodes
    bool is_pin = false;     ///< it stays where it is, unless somebody drags it
    glm::vec2 place{0.0f};   ///< present position
    glm::vec2 target{0.0f};  ///< target of a user's drag
    std::string name;
};

/// The marks of those in front of the eye that hold nodes.
std::vector<Marker> make_markers(const std::vector<HeldNodes>& held, const Scene& scene,
                                 const CameraController& camera);

/// The one whose target is nearest to the pointer, if any is within `reach`.
const Marker* find_marker(const std::vector<Marker>& markers, const glm::vec2& pointer, float reach);

}  // namespace gelatin::viewer
