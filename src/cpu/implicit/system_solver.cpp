#include "cpu/implicit/system_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cpu/contact/tuning.h"
#include "model/drive/held_up.h"
#include "model/drive/holding_forces.h"

namespace gelatin::cpu {

template <class Real>
SystemSolver<Real>::SystemSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision,
                                 const ImplicitSettings& settings)
    : CpuSolver<Real>(std::move(model), collision),
      divides_steps_(settings.divides_steps),
      step_(model_, collision, has_contacts(*model_, collision),
            has_contacts(*model_, collision) && collision.self_collision.value_or(true), settings.iterations),
      shape_matcher_(model_) {
    if (settings.sleeps && has_contacts(*model_, collision))
        rest_watch_.emplace(model_, step_.surface().thicknesses);
}

// Velocities of held nodes are those of their handles; where they are is known better than by handles, which
// bodies may have been in the way of.
template <class Real>
void SystemSolver<Real>::apply_kinematics(const Step& step) {
    const auto add_velocities = [&](double sign) {
        for (std::size_t h = 0; h < held_changes_.size(); ++h)
            held_changes_[h] += sign * glm::dvec3(current_.velocities[model_->handle_nodes[h].node]);
    };
    held_changes_.assign(model_->handle_nodes.size(), glm::dvec3(0.0));
    add_velocities(-1.0);
    CpuSolver<Real>::apply_kinematics(step);
    add_velocities(1.0);
}

// Wakes bodies that are driven. Where all rest, they and what is held stay where they are.
template <class Real>
bool SystemSolver<Real>::rests(const Step& step) {
    std::vector<std::uint32_t> moved = step_.set_cavity_drives(step.cavity_drives);
    if (!rest_watch_) return false;
    std::vector<Vec4<Real>> asked = current_.positions;
    std::vector<Vec3<Real>> held_at;
    for (const HandleNode& held : model_->handle_nodes) {
        if (asked[held.node].w == Real(0)) asked[held.node] = Vec4<Real>(goals_[held.node], Real(0));
        held_at.push_back(held_at_.empty() ? Vec3<Real>(current_.positions[held.node]) : held_at_[held.node]);
    }
    const std::vector<std::uint32_t> by_motors = step_.moved_by(step.motors);
    moved.insert(moved.end(), by_motors.begin(), by_motors.end());
    if (!rest_watch_->begin({step.size, asked, step.load_factors, this->acting_pulls(), held_at, moved}))
        return false;
    for (std::size_t n = 0; n < goals_.size(); ++n) {
        Vec4<Real>&position = current_.positions[n], &velocity = current_.velocities[n];
        if (position.w == Real(0) && !held_at_.empty()) position = Vec4<Real>(held_at_[n], Real(0));
        velocity = Vec4<Real>(Vec3<Real>(0), velocity.w);
    }
    return true;
}

// What was blocked is behind its keyframes. It makes up for that no faster than it moves by them, or than
// bodies' thickness in a frame: else it would hit what blocks it with all that it is behind, in one step.
template <class Real>
void SystemSolver<Real>::slow_blocked(Real size) {
    if (held_at_.empty()) return;
    const std::vector<double>& thicknesses = step_.surface().thicknesses;
    const auto least =
        static_cast<Real>(*std::max_element(thicknesses.begin(), thicknesses.end()) / tuning::kFrame);
    for (std::size_t n = 0; n < goals_.size(); ++n) {
        if (current_.positions[n].w != Real(0)) continue;
        const Vec3<Real> behind = Vec3<Real>(current_.positions[n]) - held_at_[n];
        const Real found = glm::length(behind),
                   most = size * std::max(least, glm::length(Vec3<Real>(current_.velocities[n])));
        if (found > most) goals_[n] -= (Real(1) - most / found) * behind;
    }
}

template <class Real>
void SystemSolver<Real>::advance_nodes(const Step& step) {
    size_ = step.size;
    StageTimer* const timer = this->timer_.for_parts();
    const auto size = static_cast<Real>(step.size);
    // Held nodes go from where they are to where their handles have them at the end.
    goals_.resize(current_.positions.size());
    for (std::size_t n = 0; n < goals_.size(); ++n)
        if (current_.positions[n].w == Real(0))
            goals_[n] = Vec3<Real>(current_.positions[n]) + size * Vec3<Real>(current_.velocities[n]);
    if (rests(step)) return;
    slow_blocked(size);
    const std::vector<Vec4<Real>> velocities = current_.velocities;
    const Real shortest = size / static_cast<Real>(tuning::kMostParts);
    StepInput<Real> input{size,         divides_steps_ ? size : Real(0),
                          load_forces_, this->acting_pulls(),
                          step.motors,  rest_watch_ ? &*rest_watch_ : nullptr};
    if (this->has_response()) step_.change();
    if (std::exchange(goes_on_, false)) step_.go_on(current_, previous_.velocities, size);
    to_ = current_;
    if (rest_watch_) rest_watch_->hold(to_);
    from_ = to_;
    if (!shape_matcher_.run(to_, step.size).empty() && !step_.follow(from_, to_)) to_ = from_;
    Real longest =
        size;  // twice the last part, so that those that are divided do not begin with all that is left
    bool any_is_made = false;
    for (Real left = size; left > Real(0.5) * shortest; left -= input.step) {
        for (std::size_t n = 0; n < goals_.size(); ++n) {
            if (current_.positions[n].w != Real(0)) continue;
            if (left == size && !held_at_.empty()) to_.positions[n] = Vec4<Real>(held_at_[n], Real(0));
            to_.velocities[n] =
                Vec4<Real>((goals_[n] - Vec3<Real>(to_.positions[n])) / left, to_.velocities[n].w);
        }
        from_ = to_;
        this->sum_loads(step, from_);
        input.step = std::min(left, longest);
        input.step = step_.run(input, shortest, from_, to_, timer);
        any_is_made = any_is_made || step_.is_made();
        // What fails in all parts of a step is left as it is found: whoever watches it says so.
        if (!step_.is_made() && (any_is_made || left - input.step > Real(0.5) * shortest))
            step_.stand_still(from_, to_);
        longest = Real(2) * input.step;
    }
    if (!model_->handles.empty() && model_->is_body(model_->handles[0].object))
        step_.find_forces_on_held(input, from_, forces_on_held_);
    if (rest_watch_) {
        rest_watch_->release(to_);
        rest_watch_->end(step_.islands().of_bodies);
    }
    // Whoever reads nodes keeps those of the step's start; the next step goes on from its last part.
    std::swap(current_, previous_);
    current_ = to_;
    previous_.velocities = from_.velocities;
    held_at_.assign(current_.positions.begin(), current_.positions.end());
    for (std::size_t n = 0; n < goals_.size(); ++n)
        if (current_.positions[n].w == Real(0)) current_.velocities[n] = velocities[n];
    has_earlier_ = true;
}

template <class Real>
void SystemSolver<Real>::set_attachments(const std::vector<Attachment>& attachments) {
    step_.set_attachments(attachments);
    if (rest_watch_) rest_watch_->restart();
}

template <class Real>
HoldingForces SystemSolver<Real>::holding_forces() {
    const bool holds_bodies = !model_->handles.empty() && model_->is_body(model_->handles[0].object);
    if (!holds_bodies) return {};
    std::vector<glm::dvec3> others = forces_on_held_;
    if (!load_forces_.empty())
        for (std::size_t n = 0; n < others.size(); ++n) others[n] += glm::dvec3(load_forces_[n]);
    std::vector<glm::dvec3> accelerations = held_changes_;
    for (glm::dvec3& acceleration : accelerations) acceleration /= size_;
    return find_holding_forces<Real>(*model_, current_.positions, others, accelerations);
}

template <class Real>
std::vector<std::uint32_t> SystemSolver<Real>::held_up(std::span<const glm::dvec3> places) {
    return find_held_up<Vec4<Real>>(*model_, step_.surface().thicknesses, current_.positions, places);
}

template <class Real>
void SystemSolver<Real>::write_state(const State& state) {
    CpuSolver<Real>::write_state(state);
    forget();
    goes_on_ = !restore(state.memory) && has_earlier_;
}

template <class Real>
bool SystemSolver<Real>::restore(std::string_view memory) {
    Archive archive = Archive::that_reads(memory);
    this->archive(archive);
    if (!archive.is_complete()) forget();
    return archive.is_complete();
}

template <class Real>
void SystemSolver<Real>::forget() {
    step_.restart();
    shape_matcher_.forget();
    if (rest_watch_) rest_watch_->restart();
    held_at_.clear();
    held_changes_.clear();
    forces_on_held_.clear();
}

template <class Real>
std::string SystemSolver<Real>::memory() {
    std::string bytes;
    Archive archive = Archive::that_writes(bytes);
    this->archive(archive);
    return bytes;
}

// Numbers of colliders, attachments and cavities, which are in it, mean the same only where there are as
// many.
template <class Real>
void SystemSolver<Real>::archive(Archive& archive) {
    const std::array<std::size_t, 6> kind{
        sizeof(Real),          model_->objects.size(),   model_->colliders.size(),
        rest_watch_ ? 1u : 0u, step_.attachment_count(), model_->cavities.size()};
    std::array<std::size_t, 6> written = kind;
    archive.value(written);
    if (written != kind) return archive.fail();
    step_.archive(archive);
    shape_matcher_.archive(archive);
    if (rest_watch_) rest_watch_->archive(archive);
    archive.list(held_at_);
    archive.list(forces_on_held_);
    archive.list(held_changes_);
    archive.value(size_);
    const auto fits = [](std::size_t size, std::size_t wanted) { return size == 0 || size == wanted; };
    if (!fits(held_at_.size(), model_->node_count()) || !fits(forces_on_held_.size(), model_->node_count()) ||
        !fits(held_changes_.size(), model_->handle_nodes.size()))
        archive.fail();
}

template class SystemSolver<float>;
template class SystemSolver<double>;

}  // namespace gelatin::cpu
