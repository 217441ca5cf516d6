#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin::test {

struct NodeArrays {
    std::vector<glm::vec4> positions, velocities;  ///< with kGuard elements behind the nodes
};

/// One step on the GPU from the model's start, every buffer that is written poisoned first and guarded behind
/// its end.
NodeArrays step_on_gpu(const Model& model, SolverKind solver, ForceMethod forces, double step);

}  // namespace gelatin::test
