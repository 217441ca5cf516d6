#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gelatin {

/// A hand that holds nodes: a damped spring draws each of them to its own place beside `target`, for as long
/// as somebody holds on. A body that is let go keeps its momentum.
struct Pull {
    struct Node {
        std::uint32_t node;
        glm::vec3 arm;    ///< its place, from the target [m]
        float stiffness;  ///< of its spring [N/m], > 0
    };
    std::vector<Node> nodes;    ///< each once
    glm::dvec3 target{0.0};     ///< [m]
    double damping_time = 0.0;  ///< damping over stiffness [s]; critical for a mass m on k: 2 sqrt(m / k)
};

}  // namespace gelatin
