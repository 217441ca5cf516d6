#pragma once

#include <vector>

#include "cpu/nodes.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// Sums over each object, in double for any precision of the nodes; the same bits for any number of threads.
/// GLSL twins: shaders/sim/measure/measure_nodes.comp and measure_faces.comp.
template <class Real>
std::vector<ObjectMeasure> measure(const Model& model, const Nodes<Real>& nodes);

}  // namespace gelatin::cpu
