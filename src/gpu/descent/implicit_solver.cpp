#include "gpu/descent/implicit_solver.h"

#include <utility>

namespace gelatin::gpu {

ImplicitSolver::ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision,
                               const DescentSettings& descent)
    : GpuSolver(std::move(model), collision), descent_(*model_, descent), shape_matcher_(*model_) {}

void ImplicitSolver::advance_nodes(const Step& step) {
    const SumLoads* const loads = loads_of(step);
    std::swap(current_, previous_);
    StageTimer* const timer = timer_.for_parts();
    {
        const TimedStage part(timer, "advance_nodes.match_shapes");
        shape_matcher_.run(previous_);
    }
    if (loads != nullptr) loads->run(previous_);
    descent_.run(buffers_, loads, previous_, current_, step.size, std::exchange(has_earlier_, true), timer);
}

}  // namespace gelatin::gpu
