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

/// Shows what a pin or a handle holds, by its centre in the picture. Places are CameraController's.
struct Marker {
    std::size_t held = 0;    ///< index in Simulator::held_nodes
    bool is_pin = false;     ///< it stays where it is, for as long as nobody drags it
    glm::vec2 place{0.0f};   ///< where it is
    glm::vec2 target{0.0f};  ///< where a user has dragged it
    std::string name;
};

/// Those in front of the eye that hold something.
std::vector<Marker> make_markers(const std::vector<HeldNodes>& held, const Scene& scene,
                                 const CameraController& camera);

/// The one whose target is nearest to the pointer, if any is within `reach`.
const Marker* find_marker(const std::vector<Marker>& markers, const glm::vec2& pointer, float reach);

}  // namespace gelatin::viewer
