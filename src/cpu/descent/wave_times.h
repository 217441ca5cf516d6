#pragma once

#include <vector>

#include "model/model.h"

namespace gelatin::cpu {

/// The time that a pressure wave takes through each object: V^(1/3) sqrt(rho / K) [s], shape [objects]; 0 for
/// colliders.
std::vector<double> wave_times(const Model& model);

}  // namespace gelatin::cpu
