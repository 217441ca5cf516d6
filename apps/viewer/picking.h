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

/// The faces that are drawn: those of the skin, or of the boundary of the tets where there is none.
std::span<const Face> drawn_faces(const Model& model);
/// What they are between. @param positions x, y, z of each node [m] @return x, y, z of each point, or node
/// [m]
std::vector<float> drawn_positions(const Model& model, std::vector<float> positions);

/// The first face that a ray meets.
struct Pick {
    std::uint32_t face = 0;    ///< index in drawn_faces
    std::uint32_t object = 0;  ///< index in Model::objects
    glm::vec3 point{0.0f};     ///< [m]
    float distance = 0.0f;     ///< along the ray [m]
};

/// Tests every face from its front: from behind none is drawn.
/// @param positions x, y, z of what the faces are between [m]
std::optional<Pick> pick(const Ray& ray, std::span<const float> positions, std::span<const Face> faces);

/// A point of a face that is drawn, which moves with it.
struct FacePoint {
    Face face{};
    glm::vec3 weights{0.0f};  ///< of its corners; the sum is 1
};

/// @param positions x, y, z of what the faces are between [m]; the same below
FacePoint face_point(const Pick& pick, const Face& face, std::span<const float> positions);
glm::vec3 place_of(const FacePoint& point, std::span<const float> positions);
/// [m]
float shortest_edge(const FacePoint& point, std::span<const float> positions);

/// A pull at the picked point. It holds the object's nodes around it, the nearest most firmly, and always
/// those that carry the face's corners. The springs are as stiff as would make the whole body follow like a
/// critically damped oscillator of kHandRate.
/// @param positions present ones of the nodes
Pull take_hold(const Model& model, std::span<const float> positions, const Pick& pick);

/// The region at rest of the nodes that a pull holds most firmly: half as large as its reach.
SphereRegion region_of(const Pull& pull, const Model& model);

/// How fast a body follows the pull: its angular frequency [1/s].
constexpr double kHandRate = 14.0;

}  // namespace gelatin::viewer
