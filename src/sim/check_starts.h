#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

/// Objects that start so deep inside a collider that their nodes are not all pushed out on one side, which
/// tears them, a line for each collider: deeper than half of how thick they are across the collider's
/// surface. Shallower starts are put outside without harm.
/// @param positions of all nodes at the start: xyz [m]
std::vector<std::string> check_starts(const Model& model, const Scene& scene,
                                      std::span<const glm::vec4> positions);

}  // namespace gelatin
