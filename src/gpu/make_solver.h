#pragma once

#include <memory>

#include "gpu/gpu_solver.h"

namespace gelatin::gpu {

/// @param forces of explicit solvers @param implicit of implicit ones @pre no contacts between bodies
std::unique_ptr<GpuSolver> make_solver(std::shared_ptr<const Model> model, SolverKind solver,
                                       ForceMethod forces = ForceMethod::fused,
                                       const CollisionSettings& collision = {},
                                       const ImplicitSettings& implicit = {});

}  // namespace gelatin::gpu
