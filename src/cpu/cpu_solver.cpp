#include "cpu/cpu_solver.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <type_traits>
#include <utility>

#include "core/counted.h"
#include "cpu/collision/respond.h"
#include "cpu/descent/holding_forces.h"
#include "cpu/drive/apply_kinematics.h"
#include "cpu/drive/sum_loads.h"
#include "cpu/measure/measure.h"
#include "cpu/measure/watch_nodes.h"

namespace gelatin::cpu {
namespace {

// Divides [0, count) into ranges for the threads; results never depend on the division.
template <class Work>
void for_ranges(std::uint32_t count, std::uint32_t grain, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, grain), [&](const auto& range) {
        work(Range{range.begin(), range.end() - range.begin()});
    });
}

constexpr std::uint32_t kSlicesATask = 8;
constexpr std::uint32_t kElementsATask = 2048;

std::uint32_t slice_count(const Model& model) {
    return static_cast<std::uint32_t>(model.half_springs.slice_starts.size() - 1);
}

template <class Real>
std::vector<Vec4<Real>> converted(const std::vector<glm::vec4>& values) {
    return {values.begin(), values.end()};
}

// In float with SIMD; in double the plain reference, which needs no tables for that.
TetBlocks tets_for(const Nodes<float>&, const Model& model) {
    return make_pass_tets(model);
}
TetBlocks tets_for(const Nodes<double>&, const Model&) {
    return {};
}
void find_stresses(const Model& model, const TetBlocks& tets, const Nodes<float>& at,
                   std::span<float> stresses, Range slices) {
    find_volume_stresses_simd(model, tets, at, stresses, slices);
}
void find_stresses(const Model& model, const TetBlocks&, const Nodes<double>& at, std::span<double> stresses,
                   Range slices) {
    cpu::find_volume_stresses<double>(model, at, stresses, slices);
}
void advance(const Pass<float>& pass, const TetBlocks& tets, Range slices) {
    advance_nodes_simd(pass, tets, slices);
}
void advance(const Pass<double>& pass, const TetBlocks&, Range slices) {
    advance_nodes(pass, slices);
}
std::string arithmetic(const Nodes<float>&) {
    return simd_target();
}
std::string arithmetic(const Nodes<double>&) {
    return "double";
}

template <class Real>
BoxMargin<Real> margin_for(const CollisionSettings& settings) {
    if (!settings.proximity_radius) return {};
    return BoxMargin<Real>::for_distance(*settings.proximity_radius);
}

}  // namespace

template <class Real>
CpuSolver<Real>::CpuSolver(std::shared_ptr<const Model> model, SolverKind solver, ForceMethod forces,
                           const CollisionSettings& collision, const DescentSettings& descent,
                           DeviceSweeps* device)
    : model_(std::move(model)),
      scheme_(explicit_scheme(solver)),
      forces_(forces),
      pulls_(model_->node_count()),
      collision_(model_, collision.broad_phase, collision.detection, margin_for<Real>(collision)),
      contact_{collision.friction, collision.restitution} {
    current_ = {converted<Real>(model_->positions), converted<Real>(model_->velocities)};
    previous_ = current_;
    const bool has_contact = collision.response == CollisionResponse::contact;
    if (solver == SolverKind::vbd) {
        std::unique_ptr<Contacts<Real>> contacts;
        if (has_contacts(*model_, collision)) contacts = std::make_unique<Contacts<Real>>(model_, collision);
        descent_.emplace(
            Descent{{model_, descent, BlockDescent<Real>::kNodesABatch, std::move(contacts), device},
                    ShapeMatcher<Real>(model_)});
    }
    if (scheme_.pass_count > 1) sums_ = stage_[0] = stage_[1] = current_;
    const bool meets_itself = collision.self_collision.value_or(false);
    if (meets_itself && !has_contact) {
        self_ = std::make_unique<SelfStages>(SelfStages{{model_, collision_}, {model_, contact_}});
    }
    if (collision.proximity_radius)
        proximities_.emplace(model_, collision_, *collision.proximity_radius, meets_itself);
    if (forces_ == ForceMethod::divide_and_merge) {
        spring_forces_.resize(model_->springs.size());
        node_forces_.resize(model_->node_count());
    }
    if (!descent_) pass_tets_ = tets_for(current_, *model_);
    load_factors_.assign(model_->loads.spans.size(), 1.0f);
    if (!model_->volume_term.is_empty() && !descent_) volume_stresses_.resize(model_->node_count());
    if (!model_->loads.empty()) load_forces_.assign(model_->node_count(), Vec4<Real>(0));
}

template <class Real>
void CpuSolver<Real>::apply_kinematics(std::span<const HandleMotion> motions) {
    const auto add_velocities = [&](double sign) {
        for (std::size_t h = 0; h < held_changes_.size(); ++h)
            held_changes_[h] += sign * glm::dvec3(current_.velocities[model_->handle_nodes[h].node]);
    };
    held_changes_.assign(model_->handle_nodes.size(), glm::dvec3(0.0));
    add_velocities(-1.0);
    cpu::apply_kinematics(*model_, motions, current_);
    add_velocities(1.0);
}

template <class Real>
void CpuSolver<Real>::set_load_factors(std::span<const float> factors) {
    load_factors_.assign(factors.begin(), factors.end());
}

template <class Real>
void CpuSolver<Real>::set_pulls(std::vector<Pull> pulls) {
    clear_pulled_forces();
    pulls_.set_pulls(std::move(pulls));
}

template <class Real>
void CpuSolver<Real>::set_forces(std::span<const glm::vec3> forces) {
    clear_pulled_forces();
    pulls_.set_forces(forces);
}

template <class Real>
void CpuSolver<Real>::clear_pulled_forces() {
    if (load_forces_.empty()) return;
    for (const std::uint32_t n : pulls_.nodes()) load_forces_[n] = Vec4<Real>(0);
}

// Adds to the loads, for explicit schemes.
template <class Real>
void CpuSolver<Real>::add_pulls(const Nodes<Real>& nodes, Real step) {
    for (const std::uint32_t n : pulls_.nodes()) {
        const Vec3<Real> velocity(nodes.velocities[n]);
        load_forces_[n] += Vec4<Real>(pulls_.force(n, nodes.positions[n], velocity, step), 0);
    }
}

template <class Real>
void CpuSolver<Real>::advance_nodes(double step) {
    step_ = step;
    if (descent_) {
        descend(*descent_, step);
    } else {
        run_scheme(step);
    }
}

template <class Real>
void CpuSolver<Real>::descend(Descent& descent, double step) {
    if (descent.solver.rests(step, load_factors_, acting_pulls() != nullptr, current_)) {
        previous_ = current_;
        return;
    }
    StageTimer* const timer = timer_.for_parts();
    const int parts = descent.solver.parts(step, current_);
    for (int p = 0; p < parts; ++p) {
        std::swap(current_, previous_);
        {
            const TimedStage part(timer, "advance_nodes.match_shapes");
            const std::vector<std::uint32_t> matched = descent.shape_matcher.run(previous_);
            if (!matched.empty())
                descent.solver.follow(static_cast<Real>(step / parts), matched, previous_, timer);
        }
        sum_loads(previous_);
        descent.solver.run(static_cast<Real>(step / parts), std::exchange(has_earlier_, true), previous_,
                           current_, load_forces_, acting_pulls(), timer, parts);
    }
}

template <class Real>
void CpuSolver<Real>::run_scheme(double step) {
    const Nodes<Real>* from = &current_;
    for (int p = 0; p < scheme_.pass_count; ++p) {
        Nodes<Real>& to = p + 1 == scheme_.pass_count ? previous_ : stage_[p % 2];
        const bool is_pulled = acting_pulls() != nullptr;
        if (is_pulled && load_forces_.empty()) load_forces_.assign(model_->node_count(), Vec4<Real>(0));
        clear_pulled_forces();
        sum_loads(*from);
        if (is_pulled) add_pulls(*from, static_cast<Real>(step));
        find_volume_stresses(*from);
        Pass<Real> pass = make_pass(*model_, scheme_, p, step, current_, *from, to, sums_);
        if (!load_forces_.empty()) pass.load_forces = load_forces_.data();
        if (!volume_stresses_.empty()) pass.volume_stresses = volume_stresses_.data();
        run_pass(pass);
        from = &to;
    }
    std::swap(current_, previous_);
}

template <class Real>
void CpuSolver<Real>::sum_loads(const Nodes<Real>& nodes) {
    if (!load_forces_.empty())
        cpu::sum_loads<Real>(model_->loads, load_factors_, nodes.positions, load_forces_);
}

template <class Real>
void CpuSolver<Real>::find_volume_stresses(const Nodes<Real>& nodes) {
    if (volume_stresses_.empty()) return;
    for_ranges(slice_count(*model_), kSlicesATask,
               [&](Range slices) { find_stresses(*model_, pass_tets_, nodes, volume_stresses_, slices); });
}

template <class Real>
void CpuSolver<Real>::run_pass(const Pass<Real>& pass) {
    const std::uint32_t nodes = model_->node_count();
    if (forces_ == ForceMethod::fused) {
        for_ranges(slice_count(*model_), kSlicesATask,
                   [&](Range slices) { advance(pass, pass_tets_, slices); });
        return;
    }
    for_ranges(static_cast<std::uint32_t>(model_->springs.size()), kElementsATask,
               [&](Range range) { write_spring_forces<Real>(pass, spring_forces_, range); });
    for_ranges(nodes, kElementsATask,
               [&](Range range) { merge_spring_forces<Real>(*model_, spring_forces_, node_forces_, range); });
    for_ranges(nodes, kElementsATask, [&](Range range) { integrate_nodes<Real>(pass, node_forces_, range); });
}

template <class Real>
void CpuSolver<Real>::respond(double step) {
    // An object's own contacts come first: they are computed for the positions at which they were found.
    if (self_) self_->response.run(self_->collision, static_cast<Real>(step), previous_, current_);
    cpu::respond(*model_, collision_, contact_, static_cast<Real>(step), previous_, current_);
}

template <class Real>
void CpuSolver<Real>::watch_nodes(std::uint32_t step_number, double most_energy) {
    cpu::watch_nodes<Real>(current_, step_number, static_cast<Real>(most_energy), alarm_);
}

template <class Real>
void CpuSolver<Real>::begin_measure() {
    Measured& measured = measures_.emplace_back(Measured{measure(*model_, current_), {}});
    for (std::size_t o = 0; o < model_->body_count(); ++o) {
        const Range& faces = model_->objects[o].faces;
        std::uint32_t& count = measured.objects[o].colliding_faces;
        for (std::uint32_t f = faces.first; f < faces.end(); ++f) count += collides(f) ? 1 : 0;
    }
    if (proximities_) measured.proximities = proximities_->measure();
}

template <class Real>
bool CpuSolver<Real>::collides(std::uint32_t face) const {
    return collision_.collides(face) || (self_ && self_->collision.collides(face));
}

template <class Real>
std::vector<ObjectMeasure> CpuSolver<Real>::end_measure() {
    const Measured oldest = std::move(measures_.front());
    measures_.pop_front();
    measured_proximities_ = oldest.proximities;
    return oldest.objects;
}

template <class Real>
ContactForces CpuSolver<Real>::contact_forces() const {
    return descent_ ? descent_->solver.contact_forces(current_.positions) : ContactForces();
}

template <class Real>
std::vector<std::uint32_t> CpuSolver<Real>::held_up(std::span<const HandlePose> poses) const {
    return descent_ ? descent_->solver.held_up(poses, current_.positions) : std::vector<std::uint32_t>();
}

template <class Real>
HoldingForces CpuSolver<Real>::holding_forces() const {
    const bool holds_bodies = !model_->handles.empty() && model_->is_body(model_->handles[0].object);
    if (!descent_ || !holds_bodies) return {};
    std::vector<glm::dvec3> others = descent_->solver.forces_on_held(current_.positions, acting_pulls());
    if (!load_forces_.empty())
        for (std::size_t n = 0; n < others.size(); ++n) others[n] += glm::dvec3(load_forces_[n]);
    std::vector<glm::dvec3> accelerations = held_changes_;
    for (glm::dvec3& acceleration : accelerations) acceleration /= step_;
    return find_holding_forces<Real>(*model_, current_.positions, others, accelerations);
}

template <class Real>
State CpuSolver<Real>::read_state() const {
    State state{{current_.positions.begin(), current_.positions.end()},
                {current_.velocities.begin(), current_.velocities.end()},
                {}};
    if (has_earlier_) state.earlier_velocities = {previous_.velocities.begin(), previous_.velocities.end()};
    return state;
}

// The float solver's are the state itself; the reference's are not in single precision.
template <class Real>
std::span<const glm::vec4> CpuSolver<Real>::host_positions() const {
    if constexpr (std::is_same_v<Real, float>) return current_.positions;
    return {};
}

template <class Real>
std::span<const glm::vec4> CpuSolver<Real>::host_velocities() const {
    if constexpr (std::is_same_v<Real, float>) return current_.velocities;
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
    if (descent_) descent_->solver.restart(current_.positions);
    held_changes_.clear();
    alarm_ = kNoAlarm;
}

template <class Real>
std::string CpuSolver<Real>::device() const {
    const std::size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return fmt::format("CPU, {}, {}", counted(threads, "thread"), arithmetic(current_));
}

template class CpuSolver<float>;
template class CpuSolver<double>;

}  // namespace gelatin::cpu
