#include "gpu/implicit/implicit_solver.h"

#include <utility>

namespace gelatin::gpu {

ImplicitSolver::ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision,
                               const ImplicitSettings& /*settings*/)
    : GpuSolver(std::move(model), collision) {}

void ImplicitSolver::advance_nodes(const Step& /*step*/) {}

}  // namespace gelatin::gpu
