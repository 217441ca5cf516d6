#pragma once

#include <cstdint>
#include <string>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

/// The likely cause of a node's divergence, for the user: what is unusual about the mesh near it, and whether
/// the step is too long for a strongly compressed body. Never empty.
/// @param step_size [s]
std::string likely_cause(const Model& model, const Scene& scene, std::uint32_t node, double step_size);

/// The node of an object whose springs are stiffest relative to its mass: the most likely one to diverge.
std::uint32_t stiffest_node(const Model& model, const ModelObject& object);

}  // namespace gelatin
