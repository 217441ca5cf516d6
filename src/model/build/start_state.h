#pragma once

#include <optional>

#include "gelatin/scene.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// The nodes when a run begins, where objects start out of shape (ObjectDescription::start); nothing where
/// none does: the model's own positions then are the start. The same in every run.
std::optional<State> deformed_start(const Scene& scene, const Model& model);

}  // namespace gelatin
