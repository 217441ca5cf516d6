#include "camera_controller.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "render/up_axis.h"

namespace gelatin::viewer {
namespace {

constexpr float kHighest = glm::radians(89.0f);      // away from the poles, where right has no direction
constexpr float kZoomNotch = 0.88f;                  // factor on the distance
constexpr float kNearest = 1e-4f, kFarthest = 1e5f;  // [m]
constexpr float kMargin = 1.1f;                      // margin: size of the picture relative to its content

}  // namespace

void CameraController::set(const render::Camera& camera, Axis up) {
    const glm::vec3 back = render::to_y_up(camera.eye - camera.target, up);
    up_ = up;
    target_ = camera.target;
    distance_ = std::clamp(glm::length(back), kNearest, kFarthest);
    azimuth_ = std::atan2(back.x, back.z);
    elevation_ = std::clamp(std::asin(std::clamp(back.y / distance_, -1.0f, 1.0f)), -kHighest, kHighest);
    field_of_view_ = camera.field_of_view;
}

render::Camera CameraController::camera() const {
    return {target_ - distance_ * forward(), target_, field_of_view_};
}

glm::vec3 CameraController::forward() const {
    const glm::vec3 back(std::sin(azimuth_) * std::cos(elevation_), std::sin(elevation_),
                         std::cos(azimuth_) * std::cos(elevation_));
    return -render::from_y_up(back, up_);
}

glm::vec3 CameraController::right() const {
    return render::from_y_up({std::cos(azimuth_), 0.0f, -std::sin(azimuth_)}, up_);
}

glm::vec3 CameraController::up() const {
    return glm::cross(right(), forward());
}

float CameraController::slope() const {
    return std::tan(glm::radians(0.5f * field_of_view_));
}

void CameraController::orbit(const glm::vec2& motion) {
    azimuth_ -= kTurn * motion.x;
    elevation_ = std::clamp(elevation_ - kTurn * motion.y, -kHighest, kHighest);
}

void CameraController::pan(const glm::vec2& motion) {
    target_ -= 2.0f * slope() * distance_ * (motion.x * right() + motion.y * up());
}

// What is under the pointer, at the target's depth, stays there.
void CameraController::zoom(float notches, const glm::vec2& place) {
    const float before = distance_;
    distance_ = std::clamp(before * std::pow(kZoomNotch, notches), kNearest, kFarthest);
    target_ += 2.0f * slope() * (before - distance_) * (place.x * right() + place.y * up());
}

void CameraController::frame(const render::Bounds& bounds, float aspect) {
    target_ = bounds.center();
    const float vertical = slope() / kMargin, horizontal = vertical * aspect;
    float distance = kNearest;
    for (const glm::vec3& corner : bounds.corners()) {
        const glm::vec3 arm = corner - target_;
        const float towards = -glm::dot(arm, forward());
        distance = std::max({distance, towards + std::abs(glm::dot(arm, right())) / horizontal,
                             towards + std::abs(glm::dot(arm, up())) / vertical});
    }
    distance_ = std::min(distance, kFarthest);
}

Ray CameraController::ray(const glm::vec2& place) const {
    const glm::vec3 direction = forward() + 2.0f * slope() * (place.x * right() + place.y * up());
    return {target_ - distance_ * forward(), glm::normalize(direction)};
}

float CameraController::depth_of(const glm::vec3& point) const {
    return glm::dot(point - camera().eye, forward());
}

glm::vec3 CameraController::at_depth(const glm::vec2& place, float depth) const {
    const Ray under = ray(place);
    return under.at(depth / glm::dot(under.direction, forward()));
}

std::optional<glm::vec2> CameraController::place_of(const glm::vec3& point) const {
    const glm::vec3 offset = point - camera().eye;
    const float depth = glm::dot(offset, forward());
    if (depth <= 0.0f) return {};
    return glm::vec2(glm::dot(offset, right()), glm::dot(offset, up())) / (2.0f * slope() * depth);
}

}  // namespace gelatin::viewer
