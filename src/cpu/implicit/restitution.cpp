#include "cpu/implicit/restitution.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>
#include <vector>

#include "cpu/descent/rigid_inertia.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// An impact is over when what is left of the approach, and what it would still change if it took as long
// again, are this part of the approach.
constexpr double kLeft = 0.1;
// What takes longer is softness [s].
constexpr double kLongestImpact = 0.1;

}  // namespace

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
    for (std::size_t r = 0; r < step.rows.size(); ++r) {
        const ContactRow<Real>& row = step.rows[r];
        const auto force = static_cast<double>(row.pressing(relative<Real>(row, step.displacements)));
        if (!(force > 0.0) || row.object == row.other) continue;
        const Pair pair{row.object == kNoNode ? model_->objects.size() + row.plane() : row.object, row.other};
        if (!(restitution_of(pair) > 0.0)) continue;
        const glm::dvec3 normal(row.normal);
        glm::dvec3 point(0.0), held(0.0);  // held: velocity of what is not free
        for (std::uint32_t k = 0; k < row.count; ++k) {
            const std::uint32_t n = row.nodes[k];
            const auto weight = static_cast<double>(row.weights[k]);
            if (weight > 0.0) point += weight * glm::dvec3(current.positions[n]);
            if (!rigid.is_free(weight > 0.0 ? row.other : row.object))
                held += weight * glm::dvec3(current.velocities[n]);
        }
        const double apart = glm::dot(normal, held);
        Meeting& meeting = meetings_[pair];
        Pressing& pressing = meeting.pressing;
        pressing.force += force;
        pressing.point += force * point;
        pressing.held += force * held;
        pressing.before += force * (apart + glm::dot(normal, glm::dvec3(rigid.relative(r, before))));
        pressing.after += force * (apart + glm::dot(normal, glm::dvec3(rigid.relative(r, after))));
        meeting.impulse += step.length * force * normal;
    }
}

template <class Real>
bool Restitution<Real>::run(const Step& step, const RigidLevel<Real>& rigid, Nodes<Real>& current,
                            std::span<std::uint8_t> is_struck) {
    note(step, rigid, current);
    std::fill(is_struck.begin(), is_struck.end(), std::uint8_t(0));
    bool strikes = false;
    for (auto at = meetings_.begin(); at != meetings_.end();) {
        Meeting& meeting = at->second;
        const Pressing& now = meeting.pressing;
        if (now.force > 0.0) {
            if (meeting.time == 0.0) meeting.approach = -now.before / now.force;
            meeting.point = now.point / now.force;
            meeting.held = now.held / now.force;
        }
        meeting.time += step.length;
        const double left = kLeft * meeting.approach * now.force;
        const bool is_over =
            !(now.force > 0.0) ||
            (now.after > -left && (now.after - now.before) * meeting.time < left * step.length);
        const bool counts = meeting.approach > step.resting_speed && meeting.time < kLongestImpact;
        if (is_over && counts) strikes = strike(at->first, meeting, rigid, current, is_struck) || strikes;
        at = is_over || !counts ? meetings_.erase(at) : std::next(at);
    }
    return strikes;
}

// An impulse along all that pressed.
template <class Real>
bool Restitution<Real>::strike(const Pair& pair, const Meeting& meeting, const RigidLevel<Real>& rigid,
                               Nodes<Real>& current, std::span<std::uint8_t> is_struck) const {
    struct Side {
        std::size_t object;
        double sign;
        glm::dvec3 center;  // [m]
        RigidInertia inertia;
    };
    const glm::dvec3 normal = glm::normalize(meeting.impulse);
    std::vector<Side> sides;
    double apart = glm::dot(normal, meeting.held), mobility = 0.0;  // [m/s], [1/kg]
    for (const std::size_t object : {pair.first, pair.second}) {
        if (object >= model_->body_count() || !rigid.is_free(object)) continue;
        const Range& nodes = model_->objects[object].nodes;
        const glm::dvec3 origin(current.positions[nodes.first]);
        RigidSums sums;  // with momenta for forces
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const auto mass = static_cast<double>(model_->masses[n]);
            sums.add(glm::dvec3(current.positions[n]) - origin, mass,
                     mass * glm::dvec3(current.velocities[n]));
        }
        const Side side{object, object == pair.second ? 1.0 : -1.0, origin + RigidInertia(sums).center,
                        RigidInertia(sums)};
        const glm::dvec3 arm = meeting.point - side.center, turning = glm::cross(arm, normal);
        mobility += side.inertia.inverse_mass + glm::dot(turning, side.inertia.inverse_inertia * turning);
        apart += side.sign * glm::dot(normal, side.inertia.twist(sums.force, sums.moment).at(arm));
        sides.push_back(side);
    }
    const double lacking = restitution_of(pair) * meeting.approach - apart;
    if (!(lacking > 0.0)) return false;
    for (const Side& side : sides) {
        const glm::dvec3 impulse = side.sign * lacking / mobility * normal;
        const Twist change{side.inertia.inverse_mass * impulse,
                           side.inertia.inverse_inertia * glm::cross(meeting.point - side.center, impulse)};
        const Range& nodes = model_->objects[side.object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            current.velocities[n] +=
                Vec4<Real>(Vec3<Real>(change.at(glm::dvec3(current.positions[n]) - side.center)), 0);
        is_struck[side.object] = 1;
    }
    return !sides.empty();
}

template class Restitution<float>;
template class Restitution<double>;

}  // namespace gelatin::cpu
