#pragma once

#include <vector>

#include "model/model.h"

namespace gelatin {

/// How long a pressure wave takes to pass through each body [s].
std::vector<double> wave_times(const Model& model);

}  // namespace gelatin
