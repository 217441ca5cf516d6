#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/drive/joint.h"
#include "model/spring_packing.h"

namespace gelatin {

struct Model;

/// Two points that are kept together, each a sum of nodes:
///   sum_k w_k x_k = at,
/// where the weights of the object's nodes sum to 1, and those of the other side's to -1, if it has nodes.
struct Tie {
    static constexpr std::size_t kMostNodes = 8;

    std::array<std::uint32_t, kMostNodes> nodes{};
    std::array<float, kMostNodes> weights{};
    std::uint32_t count = 0;  ///< of nodes
    glm::vec3 at{0.0f};       ///< [m], in space; 0 where the other side has nodes
};

/// An attachment of a model's objects (AttachmentDescription).
struct Attachment {
    std::string name;
    std::uint32_t object = 0;       ///< a body
    std::uint32_t other = kNoNode;  ///< another object; kNoNode: space, or a plane
    std::uint32_t plane = kNoNode;  ///< in Model::colliders
    bool is_in_space = false;       ///< the other side has no nodes, as it never moves
    float compliance = 0.0f;        ///< [m/N]
    float break_force = std::numeric_limits<float>::infinity();  ///< [N]
    bool is_broken = false;                                      ///< from now on
    bool is_firm = false;   ///< what is tied neither rotates against the other side nor comes nearer to it
    std::vector<Tie> ties;  ///< none of a slider and a distance
    Joint joint;
    /// Of all nodes when it was made [m].
    std::shared_ptr<const std::vector<glm::vec4>> positions;
};

/// What an attachment exerts when a step has ended.
struct AttachmentForce {
    glm::dvec3 force{0.0};  ///< on its object [N]; of a broken one, what broke it
    double effort = 0.0;    ///< along the coordinate of its joint [N m] or [N]
    bool is_broken = false;
    bool has_coordinate = false;           ///< whether it is a joint with one
    double coordinate = 0.0, speed = 0.0;  ///< and how fast it changes
};

/// Whether an attachment that does not keep a distance joins two objects, so that they do not meet each
/// other, broken or not: rigid bodies, or one and a collider, as links of a chain or an arm may overlap at
/// their joint, where nothing yields; or a body and a collider that changes its shape, as flesh and its
/// bones.
bool joins(const Model& model, std::uint32_t object, std::uint32_t other);

/// Objects that are joined, the first with the lower number.
using JoinedBodies = std::set<std::pair<std::uint32_t, std::uint32_t>>;

inline bool are_joined(const JoinedBodies& joined, std::uint32_t a, std::uint32_t b) {
    return !joined.empty() && joined.contains({std::min(a, b), std::max(a, b)});
}

}  // namespace gelatin
