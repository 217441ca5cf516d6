#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// Nodes that a program holds where they are, in addition to the scene's pins.
struct AddedPin {
    std::size_t object = 0;            ///< index in Model::objects, a body's
    std::vector<std::uint32_t> nodes;  ///< of the model, distinct, not held, at least one
    std::vector<glm::vec3> places;     ///< where they stay [m], shape [nodes]
};

/// The model with more pins. They come after those of the scene, in their order, as handles with the next
/// indices.
Model with_pins(const Model& model, const std::vector<AddedPin>& pins);

}  // namespace gelatin
