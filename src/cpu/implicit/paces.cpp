#include "cpu/implicit/paces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cpu/contact/tuning.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
Paces<Real>::Paces(std::shared_ptr<const Model> model)
    : model_(std::move(model)), paces_(model_->body_count()), is_struck_(model_->body_count()) {}

template <class Real>
void Paces<Real>::forget() {
    std::fill(paces_.begin(), paces_.end(), Pace::moving);
    std::fill(is_struck_.begin(), is_struck_.end(), std::uint8_t(0));
}

template <class Real>
void Paces<Real>::archive(Archive& archive) {
    archive.array(paces_);
    archive.array(is_struck_);
}

// Which nothing but its inertia holds against the tie.
template <class Real>
bool Paces<Real>::ties_rigid_body(const ContactRow<Real>& row) const {
    return row.is_tie() && (model_->objects[row.other].is_rigid ||
                            (row.object != kNoNode && model_->objects[row.object].is_rigid));
}

template <class Real>
std::uint32_t Paces<Real>::count_parts(std::span<const ContactRow<Real>> rows) const {
    Pace pace = Pace::still;
    for (const ContactRow<Real>& row : rows) {
        if (row.is_tie() && !ties_rigid_body(row)) continue;
        for (const std::uint32_t o : {row.object, row.other})
            if (o != kNoNode && model_->is_body(o)) pace = std::min(pace, paces_[o]);
    }
    return pace == Pace::moving ? tuning::kPartsOfMoving
           : pace == Pace::calm ? tuning::kPartsOfCalm
                                : tuning::kPartsOfStill;
}

// So do bodies that are struck, for a step; and islands that touch something, and of which the step resolves
// none: what stops within a step would leave with any speed.
template <class Real>
bool Paces<Real>::choose(const Islands& islands, Real step, bool damps, std::span<ContactRow<Real>> rows,
                         TimeScheme<Real>& scheme) const {
    std::vector<Pace> paces(model_->body_count(), Pace::still);
    std::vector<std::uint8_t> is_struck(model_->body_count()), touches = is_struck, resolves = is_struck,
                                                               rigid_ties = is_struck, attached = is_struck;
    for (const ContactRow<Real>& row : rows) {
        const std::uint32_t island = islands.of_bodies[model_->is_body(row.other) ? row.other : row.object];
        if (row.is_tie()) attached[island] = 1;
        if (!row.is_tie()) {
            touches[island] = 1;
        } else if (ties_rigid_body(row)) {
            rigid_ties[island] = 1;  // nothing but these yields
        }
    }
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        const std::uint32_t island = islands.of_bodies[o];
        paces[island] = std::min(paces[island], paces_[o]);
        if (is_struck_[o] != 0) is_struck[island] = 1;
        if (scheme.resolves(o, step)) resolves[island] = 1;
    }
    const bool has_past = !damps && scheme.has_past();
    bool any_goes_on = false;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        const std::uint32_t island = islands.of_bodies[o];
        const Pace pace = paces[island];
        const bool goes_on = has_past && pace == Pace::moving && is_struck[island] == 0 &&
                             (touches[island] == 0 || resolves[island] != 0);
        if (goes_on) {
            scheme.set_second_order(o, step, rigid_ties[island] != 0 ? 0.0 : tuning::kLeftOfFast);
        } else {
            scheme.set(o, step, pace == Pace::still ? static_cast<Real>(tuning::kImpactTime) : Real(0));
        }
        any_goes_on = any_goes_on || goes_on;
    }
    // Where something holds them, momenta have to go by the scheme of nodes: by another one stiff ties to
    // what never moves make them tremble for ever.
    for (std::size_t i = 0; i < attached.size(); ++i)
        if (islands.are_held[i] != 0) attached[i] = 0;
    scheme.tie(islands.of_bodies, attached);
    for (ContactRow<Real>& row : rows) {
        const std::uint32_t body = model_->is_body(row.other) ? row.other : row.object;
        row.damping = scheme.of(body).damping / step * row.slope_of(row.gap);
    }
    return any_goes_on;
}

template <class Real>
void Paces<Real>::find(const StepSystem<Real>& system, std::span<const std::uint8_t> asleep,
                       const Nodes<Real>& current) {
    const double slow = tuning::kFrame * glm::length(glm::dvec3(model_->gravity));
    std::vector<Motion> motions(system.rigid.count(), Motion::Zero());
    std::vector<double> vibrations(model_->body_count(), 0.0), fastest = vibrations, pressing = vibrations,
                                                               approach = vibrations;
    for_each_index(0, model_->body_count(), 1, [&](std::size_t o) {
        if (asleep[o] != 0) return;
        const ModelObject& object = model_->objects[o];
        const bool is_free = system.rigid.is_free(o);
        if (is_free) motions[system.rigid.number(o)] = system.rigid.velocity(o, current.velocities);
        double squares = 0.0, mass = 0.0;
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
            const auto m = static_cast<double>(model_->masses[n]);
            Vec3<Real> v(current.velocities[n]);
            fastest[o] = std::max(fastest[o], static_cast<double>(glm::length(v)));
            if (is_free) v -= system.rigid.at(n, motions);
            squares += m * static_cast<double>(glm::dot(v, v));
            mass += m;
        }
        vibrations[o] = std::sqrt(squares / mass);
    });
    for (std::size_t r = 0; r < system.rows.size(); ++r) {
        const ContactRow<Real>& row = system.rows[r];
        const auto force = static_cast<double>(row.pressing(slip<Real>(row, system.displacements)));
        const auto speed = static_cast<double>(glm::dot(row.normal, system.rigid.relative(row, motions)));
        for (const std::uint32_t object : {row.object, row.other}) {
            if (object == kNoNode || !model_->is_body(object)) continue;
            pressing[object] += force;
            approach[object] += force * std::abs(speed);
        }
    }
    for (std::size_t o = 0; o < paces_.size(); ++o) {
        const bool is_calm = pressing[o] > 0.0 && vibrations[o] < slow && approach[o] < slow * pressing[o];
        paces_[o] = asleep[o] != 0      ? Pace::still
                    : !is_calm          ? Pace::moving
                    : fastest[o] < slow ? Pace::still
                                        : Pace::calm;
    }
}

template class Paces<float>;
template class Paces<double>;

}  // namespace gelatin::cpu
