#include "gpu/gpu_solver.h"

#include "gl/context.h"

namespace gelatin::gpu {
GpuSolver::GpuSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision)
    : model_(std::move(model)),
      buffers_(*model_),
      current_(model_->positions, model_->velocities),
      previous_(model_->positions, model_->velocities),
      device_(gl::Context::current().device().renderer),
      settings_(collision),
      plan_(plan_collision(*model_, collision)),
      whole_loads_(model_->loads.spans.size(), 1.0f),
      measure_(*model_, collision.self_collision.value_or(false)) {
    if (plan_.needs_boxes()) collision_stages();
    if (!model_->loads.empty()) sum_loads_.emplace(*model_);
}

CollisionStages GpuSolver::collision_stages() {
    if (!collision_) collision_.emplace(*model_, settings_);
    return {buffers_, *collision_};
}

void GpuSolver::set_pulls(std::vector<Pull> pulls) {
    complete();
    buffers_.pulls.set_pulls(std::move(pulls));
}

void GpuSolver::move_pull(std::size_t pull, const glm::dvec3& target) {
    complete();
    buffers_.pulls.move_pull(pull, target);
}

void GpuSolver::set_forces(std::span<const glm::vec3> forces) {
    complete();
    buffers_.pulls.set_forces(forces);
}

void GpuSolver::advance(const Step& step) {
    complete();
    StageTimer& timer = stage_timer();
    if (!step.motions.empty()) {
        const Stage stage(timer, "apply_kinematics");
        apply_kinematics(step);
    }
    {
        const Stage stage(timer, "advance_nodes");
        advance_nodes(step);
    }
    if (!collision_) return;
    complete();  // the response is to whole steps
    CollisionStages stages = collision_stages();
    run_collision_stages(plan_, stages, step.size, previous_, current_, timer);
}

void GpuSolver::apply_kinematics(const Step& step) {
    if (!apply_kinematics_) apply_kinematics_.emplace(*model_);
    apply_kinematics_->run(step.motions, step.animated, current_);
}

SumLoads* GpuSolver::loads_of(const Step& step) {
    if (!sum_loads_) return nullptr;
    sum_loads_->set_factors(step.load_factors.empty() ? std::span(whole_loads_) : step.load_factors);
    return &*sum_loads_;
}

const gl::Buffer<Box>& GpuSolver::update_tree_boxes() {
    collision_stages().update_boxes(previous_, current_);
    return collision_->buffers.face_trees.boxes;
}

void GpuSolver::begin_measure() {
    complete();
    measure_.begin(buffers_, current_, collision_ ? &collision_->buffers : nullptr,
                   collision_ && collision_->self ? &collision_->self->buffers : nullptr,
                   plan_.proximities ? &collision_->near->buffers : nullptr);
}

State GpuSolver::read_state() {
    complete();
    gl::barrier(gl::Barrier::buffer_update);
    State state;
    state.positions.resize(model_->positions.size());
    state.velocities.resize(model_->velocities.size());
    current_.positions.download(state.positions);
    current_.velocities.download(state.velocities);
    if (has_earlier_) {
        state.earlier_velocities.resize(model_->velocities.size());
        previous_.velocities.download(state.earlier_velocities);
    }
    return state;
}

void GpuSolver::write_state(const State& state) {
    complete();
    gl::barrier(gl::Barrier::buffer_update);
    for (NodeBuffers* nodes : {&current_, &previous_}) {
        nodes->positions.upload(state.positions);
        nodes->velocities.upload(state.velocities);
    }
    has_earlier_ = !state.earlier_velocities.empty();
    if (has_earlier_) previous_.velocities.upload(state.earlier_velocities);
    watch_nodes_.forget();
}

}  // namespace gelatin::gpu
