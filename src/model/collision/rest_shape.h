#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "model/layouts.h"

namespace gelatin {

struct Model;

/// The objects' rest shapes, which show where a self-collision is impossible (docs/collision.md).
struct RestShapes {
    std::vector<RestShape> objects;
    std::vector<glm::vec4>
        offsets;  ///< of the nodes, relative to their objects' centres at rest [m], shape [nodes]
    /// For each face: no face that shares no corner with it is nearer at rest [m], shape [faces].
    std::vector<float> clearances;
};

/// Computed from the positions at the model's start.
RestShapes make_rest_shapes(const Model& model);

}  // namespace gelatin
