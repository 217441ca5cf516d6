#pragma once

#include <glm/vec3.hpp>

#include "gelatin/scene.h"
#include "render/camera.h"

namespace gelatin::render {

/// What is drawn has +y up. A z-up scene is turned by -90 degrees about x for it: x stays, z becomes y.
inline glm::vec3 to_y_up(const glm::vec3& v, Axis up) {
    return up == Axis::z ? glm::vec3(v.x, v.z, -v.y) : v;
}
/// The inverse of to_y_up.
inline glm::vec3 from_y_up(const glm::vec3& v, Axis up) {
    return up == Axis::z ? glm::vec3(v.x, -v.z, v.y) : v;
}

inline Bounds to_y_up(const Bounds& bounds, Axis up) {
    const glm::vec3 a = to_y_up(bounds.min, up);
    Bounds result{a, a};
    result.add(to_y_up(bounds.max, up));
    return result;
}

inline Bounds from_y_up(const Bounds& bounds, Axis up) {
    const glm::vec3 a = from_y_up(bounds.min, up);
    Bounds result{a, a};
    result.add(from_y_up(bounds.max, up));
    return result;
}

inline Camera to_y_up(const Camera& camera, Axis up) {
    return {to_y_up(camera.eye, up), to_y_up(camera.target, up), camera.field_of_view};
}
inline Camera from_y_up(const Camera& camera, Axis up) {
    return {from_y_up(camera.eye, up), from_y_up(camera.target, up), camera.field_of_view};
}

}  // namespace gelatin::render
