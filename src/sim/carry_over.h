#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "model/drive/drags.h"
#include "model/drive/handle_arms.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// The state `start` of the model `to`, in which bodies with the same name and tets, or rigid ones with the
/// same faces, get the positions and velocities of those of `from` in `state`. Masses and damping times are
/// those of `to`; held nodes begin at rest.
State carried_over(const Model& from, const State& state, const Model& to, State start);

/// `start` with the handles of the bodies that `state` has taken from `from`: handles that hold the same
/// nodes as one of `from` get its drag; others are placed as near to their nodes as possible.
/// @param state of `to` at these times of its handles [s] @param start of `to`
Drags carried_over(const Model& from, const Drags& drags, const Model& to, const State& state,
                   const std::vector<double>& times, Drags start);

/// The delays of the handles of `to` [s]: of those that hold the same nodes as one of `from`, or move a
/// collider of the same name, that one's.
std::vector<double> carried_over(const Model& from, const std::vector<double>& delays, const Model& to);

/// What programs want of the colliders of `to` that have the name, and as many vertices, as one of `from`.
std::map<std::size_t, HandleArms::Programmed> carried_over(
    const Model& from, const std::map<std::size_t, HandleArms::Programmed>& programmed, const Model& to);

/// The gas of the cavities of `to` that have the name, the object and the law of one of `from`.
std::map<std::size_t, CavityGas> carried_over(const Model& from, const std::map<std::size_t, CavityGas>& gas,
                                              const Model& to);

/// The attachment of `to` that has the name, the object and the kind of one of `from`.
std::optional<std::size_t> find_same(const Scene& from, std::size_t attachment, const Scene& to);

/// The motors of those attachments of `to` that have the name, the object and the kind of one of `from`.
std::map<std::size_t, JointMotor> carried_over(const Scene& from,
                                               const std::map<std::size_t, JointMotor>& motors,
                                               const Scene& to);

}  // namespace gelatin
