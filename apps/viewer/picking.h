#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gelatin/pull.h"
#include "gelatin/scene.h"
#include "model/model.h"
#include "ray.h"

namespace gelatin::viewer {

/// Where a ray meets a body first.
struct Pick {
    std::uint32_t face = 0;    ///< index in Model::faces
    std::uint32_t object = 0;  ///< index in Model::objects
    glm::vec3 point{0.0f};     ///< [m]
    float distance = 0.0f;     ///< along the ray [m]
};

/// Every face is tried, from both sides, but those that the ray lies in.
/// @param positions x, y, z of each node [m]
std::optional<Pick> pick(const Ray& ray, std::span<const float> positions, std::span<const Face> faces);

/// A hand that takes hold of what was picked: of the object's nodes round there, the nearest the firmest, and
/// of the face's own three whatever the mesh is like. So much that the body as a whole would follow the hand
/// as a critically damped oscillator of kHandRate.
/// @param positions as they are now
Pull take_hold(const Model& model, std::span<const float> positions, const Pick& pick);

/// Where at rest the nodes are that a hand holds the most firmly: half as far as it reaches.
SphereRegion region_of(const Pull& pull, const Model& model);

/// How fast a body follows the hand: its angular frequency [1/s].
constexpr double kHandRate = 14.0;

}  // namespace gelatin::viewer
