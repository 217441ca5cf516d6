#pragma once

#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

/// Reports, one line each, objects of 100 m and more in the gravity of the earth, whose shapes may be in
/// millimetres, and what single precision represents badly: objects so far from the origin that their
/// springs' lengths are coarse; springs at one node, or masses of objects that may touch, of very different
/// sizes; and with the implicit solver springs so stiff that a node's inertia is lost. The simulation
/// continues with less accuracy.
/// @param step_size [s]
std::vector<std::string> check_model(const Model& model, const Scene& scene, double step_size);

}  // namespace gelatin
