#include "gpu/gpu_solver.h"

#include <utility>

#include "gl/context.h"

namespace gelatin::gpu {

GpuSolver::GpuSolver(std::shared_ptr<const Model> model, SolverKind solver, ForceMethod forces,
                     const CollisionSettings& collision, const DescentSettings& descent)
    : model_(std::move(model)),
      device_(gl::Context::current().device().renderer),
      scheme_(explicit_scheme(solver)),
      collision_settings_(collision),
      buffers_(*model_),
      current_(model_->positions, model_->velocities),
      previous_(model_->positions, model_->velocities),
      integrator_(make_integrator(*model_, scheme_, solver, forces, collision, descent)),
      measure_(*model_, collision.self_collision.value_or(false)) {
    if (scheme_.pass_count > 1) {
        for (NodeBuffers* nodes : {&stage_[0], &stage_[1], &sums_}) {
            *nodes = NodeBuffers(model_->positions, model_->velocities);
        }
    }
    const bool has_contact = collision.response == CollisionResponse::contact;
    if (!has_contact && (model_->objects.size() > 1 || collision.self_collision.value_or(false)))
        collision_.emplace(*model_, collision);
    if (!model_->loads.empty()) sum_loads_.emplace(*model_);
    if (!model_->volume_term.is_empty() && solver != SolverKind::vbd) find_volume_stresses_.emplace(*model_);
}

GpuSolver::Integrator GpuSolver::make_integrator(const Model& model, const ExplicitScheme& scheme,
                                                 SolverKind solver, ForceMethod forces,
                                                 const CollisionSettings& collision,
                                                 const DescentSettings& descent) {
    if (has_contacts(model, collision)) return {};
    if (solver == SolverKind::vbd) return Descent{{model, descent}, ShapeMatcher(model)};
    if (forces == ForceMethod::fused) return AdvanceNodes(model, scheme);
    return DivideAndMerge(model, scheme);
}

void GpuSolver::apply_kinematics(std::span<const HandleMotion> motions) {
    if (!apply_kinematics_) apply_kinematics_.emplace(*model_);
    apply_kinematics_->run(motions, current_);
}

void GpuSolver::advance_nodes(double step) {
    if (auto* descent = std::get_if<Descent>(&integrator_)) {
        descend(*descent, step);
    } else {
        run_scheme(step);
    }
}

void GpuSolver::take_step(std::span<const glm::vec4> positions, std::span<const glm::vec4> velocities) {
    std::swap(current_, previous_);
    current_.positions.upload(positions);
    current_.velocities.upload(velocities);
}

void GpuSolver::descend(Descent& descent, double step) {
    std::swap(current_, previous_);
    StageTimer* const timer = timer_.for_parts();
    {
        const TimedStage part(timer, "advance_nodes.match_shapes");
        descent.shape_matcher.run(previous_);
    }
    if (sum_loads_) sum_loads_->run(previous_);
    descent.solver.run(buffers_, sum_loads_ ? &*sum_loads_ : nullptr, previous_, current_, step,
                       std::exchange(has_earlier_, true), timer);
}

void GpuSolver::run_scheme(double step) {
    const NodeBuffers* from = &current_;
    for (int p = 0; p < scheme_.pass_count; ++p) {
        NodeBuffers& to = p + 1 == scheme_.pass_count ? previous_ : stage_[p % 2];
        if (sum_loads_) sum_loads_->run(*from);
        if (find_volume_stresses_) find_volume_stresses_->run(buffers_, *from);
        const Pass pass{scheme_,
                        p,
                        step,
                        current_,
                        *from,
                        to,
                        sums_,
                        sum_loads_ ? &*sum_loads_ : nullptr,
                        find_volume_stresses_ ? &*find_volume_stresses_ : nullptr};
        if (const auto* fused = std::get_if<AdvanceNodes>(&integrator_)) fused->run(buffers_, pass);
        if (const auto* paper = std::get_if<DivideAndMerge>(&integrator_)) paper->run(buffers_, pass);
        from = &to;
    }
    std::swap(current_, previous_);
}

void GpuSolver::update_boxes() {
    if (!collision_) collision_.emplace(*model_, collision_settings_);
    collision_->update_boxes.run(buffers_, collision_->buffers, previous_, current_);
}

void GpuSolver::find_object_pairs() {
    collision_->find_object_pairs.run(buffers_, collision_->buffers, current_);
}

void GpuSolver::find_face_collisions() {
    collision_->find_face_collisions.run(buffers_, collision_->buffers, previous_, current_);
}

void GpuSolver::find_self_collisions() {
    collision_->self->find.run(buffers_, collision_->buffers, collision_->self->buffers, current_);
}

void GpuSolver::find_proximities() {
    collision_->near->find.run(buffers_, collision_->buffers, collision_->near->buffers, current_);
}

void GpuSolver::respond(double step) {
    // An object's own contacts come first: they are computed for the positions at which they were found.
    if (collision_->self) {
        collision_->self->respond.run(buffers_, collision_->buffers, collision_->self->buffers, previous_,
                                      current_, step);
    }
    collision_->respond.run(buffers_, collision_->buffers, previous_, current_, step);
}

void GpuSolver::begin_measure() {
    const bool meets_itself = collision_ && collision_->self;
    measure_.begin(buffers_, current_, collision_ ? &collision_->buffers : nullptr,
                   meets_itself ? &collision_->self->buffers : nullptr,
                   collision_ && collision_->near ? &collision_->near->buffers : nullptr);
}

State GpuSolver::read_state() const {
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
