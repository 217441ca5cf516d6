#include "handle_drag.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

namespace gelatin::viewer {
namespace {

constexpr float kNotch = 1.05f;                   // factor of the distance
constexpr double kNotchTurn = glm::radians(5.0);  // rotation about the line of sight

}  // namespace

glm::dvec3 target_center(const HeldNodes& nodes) {
    const glm::dquat turn = nodes.target.turn * glm::conjugate(nodes.drag.turn);
    return nodes.pivot - nodes.drag.move + nodes.target.move + turn * (nodes.center - nodes.pivot);
}

HandleDrag::HandleDrag(std::size_t held, const HeldNodes& nodes, Kind kind, const CameraController& camera,
                       const glm::vec2& place)
    : held_(held),
      kind_(kind),
      place_(place),
      depth_(camera.depth_of(glm::vec3(target_center(nodes)))),
      grip_(camera.at_depth(place, depth_)),
      move_(nodes.target.move),
      target_(nodes.target) {}

void HandleDrag::move_pointer(const CameraController& camera, const glm::vec2& place) {
    const glm::vec2 motion = place - std::exchange(place_, place);
    if (kind_ == Kind::move) return move(camera);
    const double rate = CameraController::kTurn;
    const glm::dquat turn = glm::angleAxis(rate * static_cast<double>(motion.x), glm::dvec3(camera.up())) *
                            glm::angleAxis(-rate * static_cast<double>(motion.y), glm::dvec3(camera.right()));
    target_.turn = glm::normalize(turn * target_.turn);
}

void HandleDrag::scroll(const CameraController& camera, float notches) {
    if (kind_ == Kind::move) {
        depth_ *= std::pow(kNotch, notches);
        return move(camera);
    }
    const double angle = kNotchTurn * static_cast<double>(notches);
    target_.turn = glm::normalize(glm::angleAxis(angle, glm::dvec3(camera.forward())) * target_.turn);
}

void HandleDrag::move(const CameraController& camera) {
    target_.move = move_ + glm::dvec3(camera.at_depth(place_, depth_)) - grip_;
}

}  // namespace gelatin::viewer
