#include "cpu/cpu_solver.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <cassert>
#include <type_traits>

#include "core/counted.h"
#include "cpu/drive/apply_kinematics.h"
#include "cpu/drive/sum_loads.h"
#include "cpu/explicit/advance_nodes.h"
#include "cpu/measure/measure.h"
#include "cpu/measure/watch_nodes.h"

namespace gelatin::cpu {
namespace {

template <class Real>
std::vector<Vec4<Real>> converted(const std::vector<glm::vec4>& values) {
    return {values.begin(), values.end()};
}

}  // namespace

template <class Real>
CpuSolver<Real>::CpuSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision)
    : model_(std::move(model)),
      current_{converted<Real>(model_->positions), converted<Real>(model_->velocities)},
      previous_(current_),
      pulls_(model_->node_count()),
      settings_(collision),
      plan_(plan_collision(*model_, collision)),
      whole_loads_(model_->loads.spans.size(), 1.0f) {
    if (!model_->loads.empty()) load_forces_.assign(model_->node_count(), Vec4<Real>(0));
    if (plan_.needs_boxes()) collision_stages();
}

template <class Real>
CollisionStages<Real>& CpuSolver<Real>::collision_stages() {
    if (!collision_) collision_ = std::make_unique<CollisionStages<Real>>(model_, settings_, plan_);
    return *collision_;
}

template <class Real>
void CpuSolver<Real>::advance(const Step& step) {
    if (!step.motions.empty()) {
        const Stage stage(timer_, "apply_kinematics");
        apply_kinematics(step);
    }
    {
        const Stage stage(timer_, "advance_nodes");
        advance_nodes(step);
    }
    if (collision_) run_collision_stages(plan_, *collision_, step.size, previous_, current_, timer_);
}

template <class Real>
void CpuSolver<Real>::apply_kinematics(const Step& step) {
    cpu::apply_kinematics(*model_, step.motions, step.animated, current_);
}

template <class Real>
void CpuSolver<Real>::sum_loads(const Step& step, const Nodes<Real>& nodes) {
    if (!load_forces_.empty())
        cpu::sum_loads<Real>(model_->loads, load_factors(step), nodes.positions, load_forces_);
}

template <class Real>
const std::vector<AxisBox<Real>>& CpuSolver<Real>::update_tree_boxes() {
    collision_stages().update_boxes(previous_, current_);
    return collision_->collision().tree_boxes();
}

template <class Real>
void CpuSolver<Real>::watch_nodes(std::uint32_t step_number, double most_energy) {
    cpu::watch_nodes<Real>(current_, step_number, static_cast<Real>(most_energy), alarm_);
}

template <class Real>
void CpuSolver<Real>::begin_measure() {
    Measurement& measured = measures_.emplace_back();
    measured.objects = measure(*model_, current_);
    if (!collision_) return;
    for (std::size_t o = 0; o < model_->body_count(); ++o) {
        const Range& faces = model_->objects[o].faces;
        std::uint32_t& count = measured.objects[o].colliding_faces;
        for (std::uint32_t f = faces.first; f < faces.end(); ++f) count += collides(f) ? 1 : 0;
    }
    measured.proximities = collision_->measure_proximities();
}

template <class Real>
Measurement CpuSolver<Real>::end_measure() {
    Measurement oldest = std::move(measures_.front());
    measures_.pop_front();
    return oldest;
}

template <class Real>
State CpuSolver<Real>::read_state() {
    State state{{current_.positions.begin(), current_.positions.end()},
                {current_.velocities.begin(), current_.velocities.end()},
                {}};
    if (has_earlier_) state.earlier_velocities = {previous_.velocities.begin(), previous_.velocities.end()};
    return state;
}

// The float solver's are the state itself; the reference's are not in single precision.
template <class Real>
HostNodes CpuSolver<Real>::host_nodes() const {
    if constexpr (std::is_same_v<Real, float>) return {current_.positions, current_.velocities};
    return {};
}

// The arrays stay where they are: whoever reads nodes() keeps addresses that are valid.
template <class Real>
void CpuSolver<Real>::write_state(const State& state) {
    assert(state.positions.size() == current_.positions.size());
    current_.positions.assign(state.positions.begin(), state.positions.end());
    current_.velocities.assign(state.velocities.begin(), state.velocities.end());
    previous_ = current_;
    has_earlier_ = !state.earlier_velocities.empty();
    if (has_earlier_)
        previous_.velocities.assign(state.earlier_velocities.begin(), state.earlier_velocities.end());
    alarm_ = kNoAlarm;
}

template <class Real>
std::string CpuSolver<Real>::device() const {
    const std::size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const char* const arithmetic = std::is_same_v<Real, float> ? simd_target() : "double";
    return fmt::format("CPU, {}, {}", counted(threads, "thread"), arithmetic);
}

template class CpuSolver<float>;
template class CpuSolver<double>;

}  // namespace gelatin::cpu
