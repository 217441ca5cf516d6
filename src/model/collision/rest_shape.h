#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "model/layouts.h"

namespace gelatin {

struct Model;

/// The objects' shapes at rest, by which a self-collision is known to be impossible (docs/collision.md).
struct RestShapes {
    std::vector<RestShape> objects;
    std::vector<glm::vec4> offsets;  ///< of the nodes from their objects' middles at rest [m], shape [nodes]
    /// Of each face: no face that shares no corner with it is nearer at rest [m], shape [faces].
    std::vector<float> clearances;
};

/// Of the positions that the model starts from.
RestShapes make_rest_shapes(const Model& model);

}  // namespace gelatin
