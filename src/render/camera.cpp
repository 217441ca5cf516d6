#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace gelatin::render {
namespace {

constexpr float kMargin = 1.16f;  // margin: size of the picture relative to its content

// When looking straight up or down, +y has no direction in the picture.
glm::vec3 up_for(const glm::vec3& forward) {
    return std::abs(forward.y) > 0.999f ? glm::vec3(0.0f, 0.0f, -1.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
}

// The smallest picture of a set of points along one axis: the position of the camera, and its distance.
// Points are given across the view and towards the camera; slope is the tangent of half the angle of view.
class Fit {
public:
    explicit Fit(float slope) : slope_(slope) {}

    void add(float across, float towards) {
        high_ = std::max(high_, across + towards * slope_);
        low_ = std::min(low_, across - towards * slope_);
    }
    float center() const { return 0.5f * (high_ + low_); }
    float distance() const { return 0.5f * (high_ - low_) / slope_; }

private:
    float slope_;
    float high_ = -std::numeric_limits<float>::max();
    float low_ = std::numeric_limits<float>::max();
};

}  // namespace

void Bounds::add(const glm::vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
}

std::array<glm::vec3, 8> Bounds::corners() const {
    std::array<glm::vec3, 8> all;
    for (int i = 0; i < 8; ++i) {
        all[static_cast<std::size_t>(i)] = {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y,
                                            i & 4 ? max.z : min.z};
    }
    return all;
}

Bounds bounds_of(std::span<const float> positions) {
    if (positions.size() < 3) return {glm::vec3(-0.5f), glm::vec3(0.5f)};
    const glm::vec3 first(positions[0], positions[1], positions[2]);
    Bounds bounds{first, first};
    for (std::size_t i = 3; i + 2 < positions.size(); i += 3) {
        bounds.add({positions[i], positions[i + 1], positions[i + 2]});
    }
    return bounds;
}

glm::mat4 Camera::view() const {
    return glm::lookAt(eye, target, up_for(glm::normalize(target - eye)));
}

glm::mat4 Camera::projection(float aspect) const {
    const float distance = glm::length(target - eye);
    return glm::perspective(glm::radians(field_of_view), aspect, 0.02f * distance, 100.0f * distance);
}

Camera frame_bounds(const Bounds& bounds, float aspect, const ViewAngles& angles) {
    const float azimuth = glm::radians(angles.azimuth);
    const float elevation = glm::radians(angles.elevation);
    const glm::vec3 towards(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                            std::cos(azimuth) * std::cos(elevation));
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), towards));
    const glm::vec3 up = glm::cross(towards, right);

    const glm::vec3 half = glm::max(0.5f * bounds.size(), glm::vec3(1e-4f));
    const float slope = std::tan(glm::radians(0.5f * angles.field_of_view)) / kMargin;
    Fit across(slope * aspect);
    Fit upward(slope);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 point =
            half * glm::vec3(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f, corner & 4 ? 1.0f : -1.0f);
        across.add(glm::dot(point, right), glm::dot(point, towards));
        upward.add(glm::dot(point, up), glm::dot(point, towards));
    }
    Camera camera;
    camera.field_of_view = angles.field_of_view;
    camera.target = bounds.center() + across.center() * right + upward.center() * up;
    camera.eye = camera.target + std::max(across.distance(), upward.distance()) * towards;
    return camera;
}

}  // namespace gelatin::render
