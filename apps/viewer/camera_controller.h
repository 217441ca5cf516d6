#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "gelatin/scene.h"
#include "ray.h"
#include "render/camera.h"

namespace gelatin::viewer {

/// Moves the camera with the pointer. Positions and displacements of the pointer are in heights of the
/// picture, from its centre, x to the right, y up: the same for every size and density of screen.
class CameraController {
public:
    /// Starts from this camera; `frame` zooms from there. @param up the scene's up axis
    void set(const render::Camera& camera, Axis up = Axis::y);
    render::Camera camera() const;

    /// Rotates about the target, never over the poles.
    void orbit(const glm::vec2& motion);
    /// Moves so that what is at the target's depth follows the pointer.
    void pan(const glm::vec2& motion);
    /// Zooms by `notches` of a wheel (outwards, if negative), towards what is under the pointer at `place`.
    void zoom(float notches, const glm::vec2& place);
    /// Moves along the line of sight until all of `bounds` is visible.
    /// @param aspect width divided by height of the picture
    void frame(const render::Bounds& bounds, float aspect);

    /// The ray through `place`.
    Ray ray(const glm::vec2& place) const;
    /// The depth of a point in front of the eye, along the line of sight [m].
    float depth_of(const glm::vec3& point) const;
    /// The point at `place` with this depth.
    glm::vec3 at_depth(const glm::vec2& place, float depth) const;
    /// Where a point appears, in the picture or outside it; nothing if it is not in front of the eye.
    std::optional<glm::vec2> place_of(const glm::vec3& point) const;

    /// The view's axes, unit vectors.
    glm::vec3 forward() const;
    glm::vec3 right() const;
    glm::vec3 up() const;

    /// Angle of a drag over the picture's height [radians].
    static constexpr float kTurn = 3.5f;

private:
    float slope() const;  // tangent of half the vertical angle of view

    glm::vec3 target_{0.0f};
    float distance_ = 5.0f;  // [m]
    Axis up_ = Axis::y;
    // Direction of the eye as seen from the target: about the up axis from the front, +z or, with z up, -y;
    float azimuth_ = 0.0f;         // [radians]
    float elevation_ = 0.0f;       // [radians]
    float field_of_view_ = 35.0f;  // [degrees]
};

}  // namespace gelatin::viewer
