#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// What pins and handles exert on the nodes that they hold: mass times acceleration less all other forces.
/// @param others on each node but gravity [N], shape [nodes]; empty before the first step
/// @param accelerations of Model::handle_nodes [m/s^2]; empty: none
template <class Real>
HoldingForces find_holding_forces(const Model& model, std::span<const glm::vec<4, Real>> positions,
                                  std::span<const glm::dvec3> others,
                                  std::span<const glm::dvec3> accelerations);

}  // namespace gelatin
