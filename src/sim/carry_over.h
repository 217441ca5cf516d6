#pragma once

#include "model/drive/drags.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// The state `start` of the model `to`, in which bodies with the same name and tets get the positions and
/// velocities of those of `from` in `state`. Masses and damping times are those of `to`; held nodes begin at
/// rest.
State carried_over(const Model& from, const State& state, const Model& to, State start);

/// `start` with the handles of the bodies that `state` has taken from `from`: handles that hold the same
/// nodes as one of `from` get its drag; others are placed as near to their nodes as possible.
/// @param state of `to` at `time` [s] @param start of `to`
Drags carried_over(const Model& from, const Drags& drags, const Model& to, const State& state, double time,
                   Drags start);

}  // namespace gelatin
