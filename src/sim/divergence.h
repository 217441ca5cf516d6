#pragma once

#include <cstdint>
#include <string>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

/// Why a node may have left what physics allows, for the user: what is remarkable about the mesh near it, and
/// whether the step is too long for a body that is crushed. Never empty.
/// @param step_size [s]
std::string likely_cause(const Model& model, const Scene& scene, std::uint32_t node, double step_size);

/// The node of an object whose springs are stiffest for its mass: the one to suspect.
std::uint32_t stiffest_node(const Model& model, const ModelObject& object);

}  // namespace gelatin
