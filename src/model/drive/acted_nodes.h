#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gelatin/pull.h"

namespace gelatin {

/// What acts on a node from outside: the springs of all hands that hold it, as one spring, and a force.
/// GLSL twin: sim/drive/pull.glsl. There it is two texels.
struct NodeActions {
    glm::vec4 spring{0.0f};  ///< place to which it pulls [m], stiffness [N/m]; 0: no hand holds the node
    glm::vec4 force{0.0f};   ///< [N], damping time of the spring [s]
};

/// The nodes that a user or a program acts on, for both backends: by pulls and by forces.
class ActedNodes {
public:
    explicit ActedNodes(std::size_t node_count) : node_count_(node_count) {}

    /// @pre their nodes are less than the count, and distinct within a pull
    void set_pulls(std::vector<Pull> pulls);
    /// @pre there is such a pull
    void move_pull(std::size_t pull, const glm::dvec3& target);
    /// @param forces [N], shape [nodes], or empty: none
    void set_forces(std::span<const glm::vec3> forces);

    /// Those on which something acts, in ascending order.
    const std::vector<std::uint32_t>& nodes() const { return nodes_; }
    /// Shape [nodes]; empty until something has acted.
    std::span<const NodeActions> by_node() const { return by_node_; }

private:
    void update();
    void add(const Pull& pull);

    std::size_t node_count_;
    std::vector<Pull> pulls_;
    std::vector<glm::vec3> forces_;
    std::vector<std::uint32_t> nodes_;
    std::vector<NodeActions> by_node_;
};

}  // namespace gelatin
