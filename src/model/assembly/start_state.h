#pragma once

#include <optional>

#include "gelatin/scene.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// The positions at which a run begins if objects start deformed (ObjectDescription::start); empty if none
/// does, and then the model's own positions are the start. The same in every run.
std::optional<State> deformed_start(const Scene& scene, const Model& model);

}  // namespace gelatin
