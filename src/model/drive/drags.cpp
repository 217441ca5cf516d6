#include "model/drive/drags.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "model/nearest_rotation.h"

namespace gelatin {
namespace {

constexpr double kLeastSpeed =
    1e-3;  // fraction of the largest speed; otherwise the remaining displacement would never reach zero

double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat turn = b * glm::conjugate(a);
    return 2.0 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

glm::dvec3 mean(std::span<const glm::dvec3> points) {
    return std::accumulate(points.begin(), points.end(), glm::dvec3(0.0)) /
           static_cast<double>(points.size());
}

}  // namespace

Drag follow(const Drag& drag, const Drag& target, const Handle& handle, double step) {
    const glm::dvec3 displacement = target.move - drag.move;
    // The largest displacement of any node.
    const double left = glm::length(displacement) + angle_between(drag.turn, target.turn) * handle.radius;
    const double speed = std::clamp(kDragRate * left, kLeastSpeed * handle.most_speed, handle.most_speed);
    if (left <= speed * step) return target;
    const double part = speed * step / left;
    return {drag.move + part * displacement, glm::normalize(glm::slerp(drag.turn, target.turn, part))};
}

Drag nearest_drag(const HandlePose& pose, std::span<const glm::dvec3> arms,
                  std::span<const glm::dvec3> places) {
    std::vector<glm::dvec3> from;
    for (const glm::dvec3& arm : arms) from.push_back(pose.map * arm);
    const glm::dvec3 from_center = mean(from), to_center = mean(places);
    glm::dmat3 moment(0.0);
    for (std::size_t i = 0; i < from.size(); ++i)
        moment += glm::outerProduct(places[i] - to_center, from[i] - from_center);
    const glm::dquat turn = smallest_nearest_rotation(moment);
    return {to_center - turn * from_center - pose.center, turn};
}

Drags::Drags(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      has_moving_(std::any_of(model_->handles.begin(), model_->handles.end(), [](const Handle& handle) {
          return !handle.keyframes.empty() || handle.animation || std::isfinite(handle.release);
      })) {
    restart();
}

void Drags::restart() {
    std::vector<Drag> targets;
    for (const Handle& handle : model_->handles) targets.push_back(handle.drag);
    go_on_with(std::vector<Drag>(targets.size()), targets);
}

void Drags::go_on_with(std::vector<Drag> drags, std::vector<Drag> targets) {
    drags_ = std::move(drags);
    targets_ = std::move(targets);
    const auto is_away = [](const Drag& drag) { return drag != Drag(); };
    is_dragged_ = std::any_of(drags_.begin(), drags_.end(), is_away) ||
                  std::any_of(targets_.begin(), targets_.end(), is_away);
}

void Drags::set_target(std::size_t handle, const Drag& target) {
    targets_[handle] = target;
    is_dragged_ = true;
}

std::vector<HandleMotion> Drags::advance(const HandleTimes& times, double step) {
    const std::vector<Drag> before = drags_;
    for (std::size_t h = 0; h < drags_.size(); ++h)
        drags_[h] = follow(before[h], targets_[h], model_->handles[h], step);
    return handle_motions(model_->handles, before, drags_, times, step);
}

}  // namespace gelatin
