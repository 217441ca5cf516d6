#pragma once

#include <vector>

#include "cpu/descent/step_objective.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Puts bodies whose first guess leads into planes outside as a whole, where that costs less than to put each
/// node outside: what presses the nodes of a stiff body that far would bring far more energy into it than the
/// body has.
/// @param depth from which on [m] @param positions input: the guess; output: so
template <class Real>
void shift_outside(const Model& model, const StepObjective<Real>& objective, double depth,
                   std::vector<Vec4<Real>>& positions);

}  // namespace gelatin::cpu
