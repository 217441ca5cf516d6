#include "cpu/implicit/restitution.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <vector>

#include "cpu/contact/tuning.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
Restitution<Real>::Restitution(std::shared_ptr<const Model> model,
                               std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)), surface_(std::move(surface)) {}

template <class Real>
double Restitution<Real>::restitution_of(const Pair& pair) const {
    const std::size_t objects = model_->objects.size();
    return pair.first < objects ? surface_->touch(pair.first, pair.second).restitution
                                : static_cast<double>(model_->colliders[pair.first - objects].restitution);
}

// Who presses whom, and how fast they leave each other as rigid bodies, in the mean of what presses.
template <class Real>
void Restitution<Real>::note(const Step& step, const RigidLevel<Real>& rigid, const Nodes<Real>& current) {
    std::vector<Motion> before(rigid.count(), Motion::Zero()), after = before;
    for_each_index(0, model_->body_count(), 1, [&](std::size_t o) {
        if (!rigid.is_free(o)) return;
        before[rigid.number(o)] = rigid.velocity(o, step.previous.velocities);
        after[rigid.number(o)] = rigid.velocity(o, current.velocities);
    });
    for (auto& [pair, meeting] : meetings_) meeting.pressing = {};
    const auto is_free = [&](std::size_t object) { return is_free_body(object, rigid); };
    for (std::size_t r = 0; r < step.rows.size(); ++r) {
        const ContactRow<Real>& row = step.rows[r];
        const auto force = static_cast<double>(row.pressing(slip<Real>(row, step.displacements)));
        if (!(force > 0.0) || row.object == row.other) continue;
        Pair pair{row.object == kNoNode ? model_->objects.size() + row.plane() : row.object, row.other};
        double side = 1.0;  // of the row's normal; nodes of either object may press faces of the other
        if (row.object != kNoNode && row.object > row.other) {
            std::swap(pair.first, pair.second);
            side = -1.0;
        }
        if (!(restitution_of(pair) > 0.0) || !(is_free(pair.first) || is_free(pair.second))) continue;
        const glm::dvec3 normal(row.normal);
        glm::dvec3 point(0.0), held(0.0);  // held: velocity of what is not free
        for (std::uint32_t k = 0; k < row.count; ++k) {
            const std::uint32_t n = row.nodes[k];
            const auto weight = static_cast<double>(row.weights[k]);
            if (weight > 0.0) point += weight * glm::dvec3(step.previous.positions[n]);
            if (!is_free(weight > 0.0 ? row.other : row.object))
                held += weight * glm::dvec3(current.velocities[n]);
        }
        const double apart = glm::dot(normal, held), impulse = step.length * force;
        const glm::dvec3 center = rigid.center(is_free(pair.second) ? pair.second : pair.first);
        Meeting& meeting = meetings_[pair];
        meeting.size += impulse;
        meeting.impulse += side * impulse * normal;
        meeting.arm += impulse * (point - center);
        meeting.held += side * impulse * held;
        Pressing& pressing = meeting.pressing;
        pressing.force += force;
        pressing.before += force * (apart + glm::dot(normal, glm::dvec3(rigid.relative(row, before))));
        pressing.after += force * (apart + glm::dot(normal, glm::dvec3(rigid.relative(row, after))));
    }
}

template <class Real>
bool Restitution<Real>::run(const Step& step, const RigidLevel<Real>& rigid, Nodes<Real>& current) {
    if (step.rows.empty() && meetings_.empty()) return false;
    note(step, rigid, current);
    std::vector<double> energies_after(step.energies_after.begin(), step.energies_after.end());
    bool strikes = false;
    for (auto at = meetings_.begin(); at != meetings_.end();) {
        Meeting& meeting = at->second;
        const Pressing& now = meeting.pressing;
        const auto energy_of = [&](std::span<const double> energies) {
            double sum = 0.0;
            for (const std::size_t object : {at->first.first, at->first.second})
                if (object < energies.size()) sum += energies[object];
            return sum;
        };
        if (meeting.time == 0.0) {
            meeting.approach = -now.before / now.force;
            meeting.energy = energy_of(step.energies_before);
        }
        meeting.time += step.length;
        const double left = tuning::kNearly * meeting.approach;
        // Both may have been held meanwhile, or fallen asleep.
        const bool any_free = is_free_body(at->first.first, rigid) || is_free_body(at->first.second, rigid);
        const bool counts =
            any_free && meeting.approach > step.resting_speed && meeting.time < tuning::kImpactTime;
        bool is_over = !counts;
        if (counts && now.after >= -left * now.force &&
            (now.after - now.before) * meeting.time <= left * now.force * step.length) {
            const Impact impact = find_impact(at->first, meeting, rigid, current);
            is_over = impact.apart > -left;
            double lacking = restitution_of(at->first) * meeting.approach - impact.apart;
            // No more than they have lost: bodies may vibrate instead.
            if (meeting.held == glm::dvec3(0.0)) {
                const double lost = std::max(meeting.energy - energy_of(energies_after), 0.0);
                lacking =
                    std::min(lacking, std::sqrt(impact.apart * impact.apart + 2.0 * lost * impact.mobility) -
                                          impact.apart);
            }
            if (is_over && lacking > 0.0) {
                strike(impact, lacking, current);
                for (const Side& side : impact.sides)
                    energies_after[side.object] += lacking * (impact.apart + 0.5 * lacking) /
                                                   impact.mobility / static_cast<double>(impact.sides.size());
                strikes = true;
            }
        }
        at = is_over ? meetings_.erase(at) : std::next(at);
    }
    return strikes;
}

template <class Real>
typename Restitution<Real>::Impact Restitution<Real>::find_impact(const Pair& pair, const Meeting& meeting,
                                                                  const RigidLevel<Real>& rigid,
                                                                  const Nodes<Real>& current) const {
    Impact impact;
    impact.normal = glm::normalize(meeting.impulse);
    for (const std::size_t object : {pair.first, pair.second}) {
        if (!is_free_body(object, rigid)) continue;
        impact.sides.push_back({object, object == pair.second ? 1.0 : -1.0,
                                RigidPart<Real>(model_->objects[object].nodes, current)});
    }
    impact.point = impact.sides.back().body.center + meeting.arm / meeting.size;
    impact.apart = glm::dot(impact.normal, meeting.held) / meeting.size;
    for (const Side& side : impact.sides) {
        const glm::dvec3 arm = impact.point - side.body.center, turning = glm::cross(arm, impact.normal);
        impact.mobility +=
            side.body.inertia.inverse_mass + glm::dot(turning, side.body.inertia.inverse_inertia * turning);
        impact.apart += side.sign * glm::dot(impact.normal, side.body.twist.at(arm));
    }
    return impact;
}

template <class Real>
void Restitution<Real>::strike(const Impact& impact, double speed, Nodes<Real>& current) const {
    for (const Side& side : impact.sides) {
        const glm::dvec3 impulse = side.sign * speed / impact.mobility * impact.normal;
        const Twist change{
            side.body.inertia.inverse_mass * impulse,
            side.body.inertia.inverse_inertia * glm::cross(impact.point - side.body.center, impulse)};
        const Range& nodes = model_->objects[side.object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            current.velocities[n] +=
                Vec4<Real>(Vec3<Real>(change.at(glm::dvec3(current.positions[n]) - side.body.center)), 0);
    }
}

template class Restitution<float>;
template class Restitution<double>;

}  // namespace gelatin::cpu
