#pragma once

#include <vector>

#include "model/model.h"
#include "model/solver.h"

namespace gelatin::test {

/// The sums over a model's objects at its start, on the GPU.
std::vector<ObjectMeasure> measure_on_gpu(const Model& model);

/// How far the elastic energy of any object is from the double reference, over what single precision may do
/// to it: each tet's is a sum of terms of the size V (mu + lambda) of which rounding takes 16 eps, and the
/// volume term's of a node is of the size V |kappa|.
double worst_energy_error(const Model& model, const std::vector<ObjectMeasure>& actual);

}  // namespace gelatin::test
