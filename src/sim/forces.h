#pragma once

#include <vector>

#include "gelatin/scene.h"
#include "gelatin/simulator.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// What presses objects in a solver's present state, with colliders as the scene numbers them.
std::vector<ContactForce> contact_forces(const Scene& scene, const Model& model, const Solver& solver);

/// Of a solver's present state, in the order of Simulator::held_nodes; empty if the solver does not find
/// them.
std::vector<HoldingForce> holding_forces(const Model& model, const Solver& solver);

}  // namespace gelatin
