#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace gelatin::render {

/// An axis-aligned part of space [m].
struct Bounds {
    glm::vec3 min{0.0f}, max{0.0f};

    glm::vec3 center() const { return 0.5f * (min + max); }
    glm::vec3 size() const { return max - min; }
    void add(const glm::vec3& point);
    std::array<glm::vec3, 8> corners() const;
    bool operator==(const Bounds&) const = default;
};

/// The bounds of points given as x, y, z one after another; a unit cube around the origin if there are none.
Bounds bounds_of(std::span<const float> positions);

/// A perspective camera that looks from `eye` at `target`, +y up in the picture.
struct Camera {
    glm::vec3 eye{0.0f, 0.0f, 5.0f};  ///< [m]
    glm::vec3 target{0.0f};           ///< [m], != eye
    float field_of_view = 35.0f;      ///< vertical [degrees]

    glm::mat4 view() const;
    /// @param aspect width divided by height of the picture
    glm::mat4 projection(float aspect) const;
    bool operator==(const Camera&) const = default;
};

/// From where something is seen [degrees]; by default from the front, 27 degrees to the right and slightly
/// above, so that objects on a floor are seen against it.
struct ViewAngles {
    float azimuth = 27.0f;        ///< of the eye, about +y from +z
    float elevation = 15.0f;      ///< in (-90, 90)
    float field_of_view = 26.0f;  ///< vertical
};

/// A view of `bounds`, as near as possible with all of it visible and a margin around it.
Camera frame_bounds(const Bounds& bounds, float aspect, const ViewAngles& angles = {});

}  // namespace gelatin::render
