#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "ray.h"
#include "render/camera.h"

namespace gelatin::viewer {

/// Turns the pointer's ways into a camera's. Ways and places are in heights of the picture, from its centre,
/// x to the right, y up: the same for every size and density of screen.
class CameraController {
public:
    /// Takes over how this camera looks; `frame` zooms come from it.
    void set(const render::Camera& camera);
    render::Camera camera() const;

    /// Turns about the target, never over the poles.
    void orbit(const glm::vec2& way);
    /// Moves so that what is at the target's depth follows the pointer.
    void pan(const glm::vec2& way);
    /// Comes nearer by `notches` of a wheel (away, if negative), to what is under the pointer at `place`.
    void zoom(float notches, const glm::vec2& place);
    /// Moves back or forth until all of `bounds` shows, looking in the same direction.
    /// @param aspect width over height of the picture
    void frame(const render::Bounds& bounds, float aspect);

    /// What lies under `place`.
    Ray ray(const glm::vec2& place) const;
    /// How far in front of the eye a point lies, along the view [m].
    float depth_of(const glm::vec3& point) const;
    /// The point under `place` that lies so far in front.
    glm::vec3 at_depth(const glm::vec2& place, float depth) const;
    /// Where a point shows, in the picture or beside it; nothing of one that is not in front of the eye.
    std::optional<glm::vec2> place_of(const glm::vec3& point) const;

    /// The view's axes, unit.
    glm::vec3 forward() const;
    glm::vec3 right() const;
    glm::vec3 up() const;

    /// Of a drag over the picture's height [radians].
    static constexpr float kTurn = 3.5f;

private:
    float slope() const;  // tangent of half the vertical angle of view

    glm::vec3 target_{0.0f};
    float distance_ = 5.0f;        // [m]
    float azimuth_ = 0.0f;         // of the eye seen from the target, about +y from +z [radians]
    float elevation_ = 0.0f;       // [radians]
    float field_of_view_ = 35.0f;  // [degrees]
};

}  // namespace gelatin::viewer
