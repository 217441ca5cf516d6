#include "model/drive/drags.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

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

// The unit quaternion q that maximises the sum of (q from_i) . to_i is the eigenvector of this matrix with
// the largest eigenvalue.
glm::dquat nearest_rotation(std::span<const glm::dvec3> from, const glm::dvec3& from_center,
                            std::span<const glm::dvec3> to, const glm::dvec3& to_center) {
    glm::dmat3 s(0.0);  // s[b][a] = sum from_a to_b
    for (std::size_t i = 0; i < from.size(); ++i)
        s += glm::outerProduct(from[i] - from_center, to[i] - to_center);
    Eigen::Matrix4d matrix;
    matrix << s[0][0] + s[1][1] + s[2][2], s[2][1] - s[1][2], s[0][2] - s[2][0], s[1][0] - s[0][1],  //
        0.0, s[0][0] - s[1][1] - s[2][2], s[1][0] + s[0][1], s[0][2] + s[2][0],                      //
        0.0, 0.0, s[1][1] - s[0][0] - s[2][2], s[2][1] + s[1][2],                                    //
        0.0, 0.0, 0.0, s[2][2] - s[0][0] - s[1][1];
    matrix.triangularView<Eigen::StrictlyLower>() = matrix.transpose();
    // If the nodes are on a line, or there is only one, the smallest rotation is used.
    matrix(0, 0) += 1e-12 * matrix.norm() + std::numeric_limits<double>::min();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(matrix);
    const Eigen::Vector4d q = solver.eigenvectors().col(3);
    return q[0] < 0.0 ? glm::dquat(-q[0], -q[1], -q[2], -q[3]) : glm::dquat(q[0], q[1], q[2], q[3]);
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
    const glm::dquat turn = nearest_rotation(from, from_center, places, to_center);
    return {to_center - turn * from_center - pose.center, turn};
}

Drags::Drags(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      has_moving_(std::any_of(model_->handles.begin(), model_->handles.end(), [](const Handle& handle) {
          return !handle.keyframes.empty() || std::isfinite(handle.release);
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

std::vector<HandleMotion> Drags::advance(double time, double step) {
    const std::vector<Drag> before = drags_;
    for (std::size_t h = 0; h < drags_.size(); ++h)
        drags_[h] = follow(before[h], targets_[h], model_->handles[h], step);
    return handle_motions(model_->handles, before, drags_, time, step);
}

}  // namespace gelatin
