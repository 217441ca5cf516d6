#pragma once

#include "gelatin/pull.h"
#include "model/solver.h"

namespace gelatin::test {

/// A hand on about half of the nodes of the model's first object, away from where they are: strong enough to
/// move them over a good part of a step.
Pull make_pull(const Model& model);

/// One step of `solver` on the GPU with a hand on the model, against the same by the double reference: the
/// largest error over a bound, as rounding_bounds has it and, of a held node, 16 roundings of its spring's
/// force by coordinates and speeds as large as the model's; times the sweeps of vbd.
double worst_pull_error(const Model& model, SolverKind solver, ForceMethod forces, double step);

}  // namespace gelatin::test
