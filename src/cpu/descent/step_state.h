#pragma once

#include <vector>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// Where a step of vertex block descent begins, and what inertia pulls to.
template <class Real>
struct StepState {
    std::vector<Vec4<Real>> starts;   ///< xyz when the step began [m], damping time [s], shape [nodes]
    std::vector<Vec4<Real>> targets;  ///< y [m], m / h^2 [N/m], 0 where a node is held, shape [nodes]
    Real inverse_step = Real(0);      ///< 1 / h [1/s]
};

}  // namespace gelatin::cpu
