#pragma once

#include "gelatin/pull.h"
#include "model/solver.h"

namespace gelatin::test {

/// Hands on about half and a third of the nodes of the model's first object, of which some are held by both,
/// away from where they are: strong enough to move them over a good part of a step.
std::vector<Pull> make_pulls(const Model& model);

/// Forces on every fifth node, also of those that hands hold, as strong as these.
std::vector<glm::vec3> make_forces(const Model& model);

/// One step of an explicit `solver` on the GPU with hands and forces on the
/// model, of which one hand has moved and another one let go before, against the same by the double
/// reference: the largest error over a bound, as rounding_bounds has it and, of a node on which something
/// acts, 16 roundings of its force by coordinates and speeds as large as the model's.
double worst_pull_error(const Model& model, SolverKind solver, ForceMethod forces, double step);

}  // namespace gelatin::test
