#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"
#include "model/layouts.h"

namespace gelatin {

/// The loads of all objects, by node: those of node k are entries[nodes[k].first] .. entries[nodes[k].end].
struct Loads {
    struct Span {
        double from = 0.0, until = std::numeric_limits<double>::infinity();  ///< when it acts [s]
    };
    std::vector<Span> spans;        ///< for each load
    std::vector<LoadedNode> nodes;  ///< distinct, ascending
    std::vector<NodeLoad> entries;

    bool empty() const { return spans.empty(); }
};

/// The faces of the mesh whose three nodes are in the region.
std::vector<glm::uvec3> find_faces_inside(const Region& region, const TetMesh& mesh);

/// Adds the loads of an object whose nodes follow all previous ones.
/// @param mesh at rest @param masses of its nodes [kg] @param first_node of the object in the model
void append_loads(const std::vector<LoadDescription>& descriptions, const TetMesh& mesh,
                  std::span<const float> masses, std::uint32_t first_node, Loads& loads);

/// The fraction of the step of `step` seconds from `time` during which each load acts, from 0 to 1. So a
/// load's total impulse is its force times its duration.
std::vector<float> load_factors(const Loads& loads, double time, double step);

}  // namespace gelatin
