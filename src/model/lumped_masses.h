#pragma once

#include <vector>

#include "model/model.h"

namespace gelatin {

/// Sums over the nodes of each object [kg], shape [objects]; 0 for colliders. ModelObject::mass is exact, and
/// these are what moves.
std::vector<double> lumped_masses(const Model& model);

/// Of the nodes that nothing holds at the start.
std::vector<double> free_lumped_masses(const Model& model);

}  // namespace gelatin
