#pragma once

#include <memory>

#include "cpu/cpu_solver.h"

namespace gelatin::cpu {

/// @param forces of explicit solvers @param implicit of implicit ones
template <class Real>
std::unique_ptr<CpuSolver<Real>> make_solver(std::shared_ptr<const Model> model, SolverKind solver,
                                             ForceMethod forces = ForceMethod::fused,
                                             const CollisionSettings& collision = {},
                                             const ImplicitSettings& implicit = {});

}  // namespace gelatin::cpu
