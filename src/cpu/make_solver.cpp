#include "cpu/make_solver.h"

#include <utility>

#include "cpu/explicit/explicit_solver.h"
#include "cpu/implicit/system_solver.h"

namespace gelatin::cpu {

template <class Real>
std::unique_ptr<CpuSolver<Real>> make_solver(std::shared_ptr<const Model> model, SolverKind solver,
                                             ForceMethod forces, const CollisionSettings& collision,
                                             const ImplicitSettings& implicit) {
    if (solver == SolverKind::implicit)
        return std::make_unique<SystemSolver<Real>>(std::move(model), collision, implicit);
    return std::make_unique<ExplicitSolver<Real>>(std::move(model), solver, forces, collision);
}

template std::unique_ptr<CpuSolver<float>> make_solver<float>(std::shared_ptr<const Model>, SolverKind,
                                                              ForceMethod, const CollisionSettings&,
                                                              const ImplicitSettings&);
template std::unique_ptr<CpuSolver<double>> make_solver<double>(std::shared_ptr<const Model>, SolverKind,
                                                                ForceMethod, const CollisionSettings&,
                                                                const ImplicitSettings&);

}  // namespace gelatin::cpu
