#include "sim/shared_solver.h"

#include "gl/barrier.h"

namespace gelatin {

SharedSolver::SharedSolver(const std::shared_ptr<const Model>& model, ForceMethod forces,
                           const CollisionSettings& collision, const DescentSettings& descent)
    : GpuSolver(model, SolverKind::vbd, forces, collision, descent),
      sweeps_(*model, model_buffers(), descent),
      host_(model, SolverKind::vbd, forces, collision, descent, &sweeps_) {}

void SharedSolver::advance_nodes(double step) {
    host_.advance_nodes(step);
    take_step(host_.nodes().positions, host_.nodes().velocities);
    // While all bodies rest, no sweep comes between what the last step and this one write.
    gl::barrier(gl::Barrier::storage);
}

void SharedSolver::write_state(const State& state) {
    GpuSolver::write_state(state);
    host_.write_state(state);
}

}  // namespace gelatin
