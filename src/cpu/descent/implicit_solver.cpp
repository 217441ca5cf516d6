#include "cpu/descent/implicit_solver.h"

#include <utility>

namespace gelatin::cpu {

template <class Real>
ImplicitSolver<Real>::ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision,
                                     const DescentSettings& descent)
    : CpuSolver<Real>(std::move(model), collision), descent_(model_, descent), shape_matcher_(model_) {}

template <class Real>
void ImplicitSolver<Real>::advance_nodes(const Step& step) {
    StageTimer* const timer = this->timer_.for_parts();
    std::swap(current_, previous_);
    {
        const TimedStage part(timer, "advance_nodes.match_shapes");
        shape_matcher_.run(previous_);
    }
    this->sum_loads(step, previous_);
    descent_.run(static_cast<Real>(step.size), std::exchange(has_earlier_, true), previous_, current_,
                 load_forces_, this->acting_pulls(), timer);
}

template <class Real>
void ImplicitSolver<Real>::write_state(const State& state) {
    CpuSolver<Real>::write_state(state);
    descent_.restart();
}

template class ImplicitSolver<float>;
template class ImplicitSolver<double>;

}  // namespace gelatin::cpu
