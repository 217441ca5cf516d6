#pragma once

#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

/// What single precision will not do justice to, a line each: objects so far from the origin that their
/// springs' lengths are coarse, springs at one node or masses of objects that may touch of very different
/// sizes, and with vertex block descent springs beside which a node's inertia is lost. Simulation goes on,
/// less exactly.
/// @param step_size [s]
std::vector<std::string> check_model(const Model& model, const Scene& scene, double step_size);

}  // namespace gelatin
