#include "cpu/descent/implicit_solver.h"

#include <utility>

#include "cpu/descent/holding_forces.h"

namespace gelatin::cpu {
namespace {

template <class Real>
std::unique_ptr<Contacts<Real>> make_contacts(const std::shared_ptr<const Model>& model,
                                              const CollisionSettings& collision) {
    return has_contacts(*model, collision) ? std::make_unique<Contacts<Real>>(model, collision) : nullptr;
}

}  // namespace

template <class Real>
ImplicitSolver<Real>::ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision,
                                     const DescentSettings& descent, DeviceSweeps* device)
    : CpuSolver<Real>(std::move(model), collision),
      descent_(model_, descent, BlockDescent<Real>::kNodesABatch, make_contacts<Real>(model_, collision),
               device),
      shape_matcher_(model_) {}

template <class Real>
void ImplicitSolver<Real>::apply_kinematics(std::span<const HandleMotion> motions) {
    const auto add_velocities = [&](double sign) {
        for (std::size_t h = 0; h < held_changes_.size(); ++h)
            held_changes_[h] += sign * glm::dvec3(current_.velocities[model_->handle_nodes[h].node]);
    };
    held_changes_.assign(model_->handle_nodes.size(), glm::dvec3(0.0));
    add_velocities(-1.0);
    CpuSolver<Real>::apply_kinematics(motions);
    add_velocities(1.0);
}

template <class Real>
void ImplicitSolver<Real>::advance_nodes(const Step& step) {
    step_ = step.size;
    const Pulls<Real>* const pulls = this->acting_pulls();
    if (descent_.rests(step_, this->load_factors(step), pulls != nullptr, current_)) {
        previous_ = current_;
        return;
    }
    StageTimer* const timer = this->timer_.for_parts();
    const int parts = descent_.parts(step_, current_);
    for (int p = 0; p < parts; ++p) {
        std::swap(current_, previous_);
        {
            const TimedStage part(timer, "advance_nodes.match_shapes");
            const std::vector<std::uint32_t> matched = shape_matcher_.run(previous_);
            if (!matched.empty())
                descent_.follow(static_cast<Real>(step_ / parts), matched, previous_, timer);
        }
        this->sum_loads(step, previous_);
        descent_.run(static_cast<Real>(step_ / parts), std::exchange(has_earlier_, true), previous_, current_,
                     load_forces_, pulls, timer, parts);
    }
}

template <class Real>
HoldingForces ImplicitSolver<Real>::holding_forces() const {
    const bool holds_bodies = !model_->handles.empty() && model_->is_body(model_->handles[0].object);
    if (!holds_bodies) return {};
    std::vector<glm::dvec3> others = descent_.forces_on_held(current_.positions, this->acting_pulls());
    if (!load_forces_.empty())
        for (std::size_t n = 0; n < others.size(); ++n) others[n] += glm::dvec3(load_forces_[n]);
    std::vector<glm::dvec3> accelerations = held_changes_;
    for (glm::dvec3& acceleration : accelerations) acceleration /= step_;
    return find_holding_forces<Real>(*model_, current_.positions, others, accelerations);
}

template <class Real>
void ImplicitSolver<Real>::write_state(const State& state) {
    CpuSolver<Real>::write_state(state);
    descent_.restart(current_.positions);
    held_changes_.clear();
}

template class ImplicitSolver<float>;
template class ImplicitSolver<double>;

}  // namespace gelatin::cpu
