#pragma once

#include "model/drive/drags.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// The state `start` of the model `to`, with bodies of the same name and tets put where those of `from` are
/// in `state`. Masses and damping times are those of `to`; what it holds begins at rest.
State carried_over(const Model& from, const State& state, const Model& to, State start);

/// `start` with the handles of the bodies that `state` has from `from` put where they are there: those that
/// hold the same nodes as one of `from`, dragged as that is, and others as near as can be to their nodes.
/// @param state of `to` at `time` [s] @param start of `to`
Drags carried_over(const Model& from, const Drags& drags, const Model& to, const State& state, double time,
                   Drags start);

}  // namespace gelatin
