#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "camera_controller.h"
#include "gelatin/drag.h"

namespace gelatin::viewer {

/// Where a user has dragged a pin or handle to [m]: HeldNodes::center once it has arrived.
glm::dvec3 target_center(const HeldNodes& nodes);

/// Drags a pin or a handle with the mouse: in the plane that faces the eye, or about its pivot, as a drag
/// beside the bodies rotates the view. Positions are CameraController's.
class HandleDrag {
public:
    enum class Kind { move, turn };

    /// @param held index in Simulator::held_nodes, whose element `nodes` is
    HandleDrag(std::size_t held, const HeldNodes& nodes, Kind kind, const CameraController& camera,
               const glm::vec2& place);

    std::size_t held() const { return held_; }
    /// The target.
    const Drag& target() const { return target_; }

    void move_pointer(const CameraController& camera, const glm::vec2& place);
    /// Moves it away from the eye or nearer; or rotates it about the line of sight.
    void scroll(const CameraController& camera, float notches);

private:
    void move(const CameraController& camera);

    std::size_t held_;
    Kind kind_;
    glm::vec2 place_;
    float depth_;             // in front of the eye [m]
    glm::dvec3 grip_, move_;  // where it was grabbed, and its displacement then [m]
    Drag target_;
};

}  // namespace gelatin::viewer
