#include "gpu/make_solver.h"

#include <utility>

#include "gpu/explicit/explicit_solver.h"
#include "gpu/implicit/implicit_solver.h"

namespace gelatin::gpu {

std::unique_ptr<GpuSolver> make_solver(std::shared_ptr<const Model> model, SolverKind solver,
                                       ForceMethod forces, const CollisionSettings& collision,
                                       const ImplicitSettings& implicit) {
    if (solver == SolverKind::implicit)
        return std::make_unique<ImplicitSolver>(std::move(model), collision, implicit);
    return std::make_unique<ExplicitSolver>(std::move(model), solver, forces, collision);
}

}  // namespace gelatin::gpu
