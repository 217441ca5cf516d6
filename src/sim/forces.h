#pragma once

#include <vector>

#include "gelatin/scene.h"
#include "gelatin/simulator.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// What presses objects, with colliders as the scene numbers them.
/// @param found by a solver with CollisionResponse::contact
std::vector<ContactForce> contact_forces(const Scene& scene, const Model& model, const ContactForces& found);

/// At how many places colliders press bodies. @param found by a solver that finds it
std::size_t count_collider_contacts(const Model& model, const ContactForces& found);

/// Of a solver's present state, in the order of Simulator::held_nodes; empty if the solver does not find
/// them.
std::vector<HoldingForce> holding_forces(const Model& model, Solver& solver);

}  // namespace gelatin
