#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "camera_controller.h"
#include "gelatin/drag.h"

namespace gelatin::viewer {

/// Where a user has what is held on its way to [m]: HeldNodes::center once it is there.
glm::dvec3 target_center(const HeldNodes& nodes);

/// The mouse drags what a pin or a handle holds: in the plane that faces the eye, or about its pivot, as a
/// drag beside the bodies turns the view. Places are CameraController's.
class HandleDrag {
public:
    enum class Kind { move, turn };

    /// @param held index in Simulator::held_nodes, whose element `nodes` is
    HandleDrag(std::size_t held, const HeldNodes& nodes, Kind kind, const CameraController& camera,
               const glm::vec2& place);

    std::size_t held() const { return held_; }
    /// Where it shall be.
    const Drag& target() const { return target_; }

    void move_pointer(const CameraController& camera, const glm::vec2& place);
    /// Takes it away from the eye or brings it nearer; turns it about the line of sight.
    void turn_wheel(const CameraController& camera, float notches);

private:
    void move(const CameraController& camera);

    std::size_t held_;
    Kind kind_;
    glm::vec2 place_;
    float depth_;             // in front of the eye [m]
    glm::dvec3 grip_, move_;  // where it was taken hold of, and how far it was moved then [m]
    Drag target_;
};

}  // namespace gelatin::viewer
