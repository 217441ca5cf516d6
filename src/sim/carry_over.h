#pragma once

#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// The state `start` of the model `to`, with bodies of the same name and tets put where those of `from` are
/// in `state`. Masses and damping times are those of `to`.
State carried_over(const Model& from, const State& state, const Model& to, State start);

}  // namespace gelatin
