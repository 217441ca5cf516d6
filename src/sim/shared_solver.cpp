#include "sim/shared_solver.h"

#include "gl/barrier.h"

namespace gelatin {
namespace {

// Proximities are sought on the device.
CollisionSettings of_host(CollisionSettings collision) {
    collision.proximity_radius.reset();
    return collision;
}

}  // namespace

SharedSolver::SharedSolver(const std::shared_ptr<const Model>& model, const CollisionSettings& collision,
                           const ImplicitSettings& implicit)
    : GpuSolver(model, collision), host_(model, of_host(collision), implicit) {}

void SharedSolver::advance_nodes(const Step& step) {
    host_.advance_nodes(step);
    std::swap(current_, previous_);
    current_.positions.upload(host_.nodes().positions);
    current_.velocities.upload(host_.nodes().velocities);
    gl::barrier(gl::Barrier::storage);
}

void SharedSolver::write_state(const State& state) {
    GpuSolver::write_state(state);
    host_.write_state(state);
}

}  // namespace gelatin
