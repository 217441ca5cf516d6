#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gelatin {

/// Damped springs by which a user pulls at nodes. Each spring joins a node to a fixed offset from `target`.
/// When the pull ends, the body keeps its momentum.
struct Pull {
    struct Node {
        std::uint32_t node;
        glm::vec3 arm;    ///< offset from the target to the spring's other end [m]
        float stiffness;  ///< [N/m], > 0
    };
    std::vector<Node> nodes;  ///< distinct
    glm::dvec3 target{0.0};   ///< [m]
    double damping_time =
        0.0;  ///< damping divided by stiffness [s]; critical for mass m, stiffness k: 2 sqrt(m / k)
};

}  // namespace gelatin
