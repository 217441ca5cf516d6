#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "mesh/vertex_motion.h"

namespace gelatin {

/// How the nodes of a handle move by themselves, beside its keyframes and drags: their arms change.
struct HandleAnimation {
    std::optional<VertexMotion> motion;  ///< empty: a program says where they are
    std::vector<std::uint32_t> sources;  ///< the vertex that each node follows, shape [nodes of the handle]
    /// From where vertices are in their shape to arms: map vertex + offset.
    glm::dmat3 map{1.0};
    glm::dvec3 offset{0.0};  ///< [m]
    std::size_t vertex_count = 0;
    /// From the place of one node of the motion to that of another, or of itself.
    struct Bone {
        std::uint32_t from, to;
    };
    std::vector<Bone> bones = {};  ///< of a skeleton

    /// Until when they move by themselves [s].
    double end() const;
    /// Of all nodes [m]. @param vertices where those of the shape are
    std::vector<glm::dvec3> arms(const std::vector<glm::dvec3>& vertices) const;
};

}  // namespace gelatin
