#include "cpu/descent/rigid_rebound.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <utility>

#include "cpu/collision/colliders.h"
#include "cpu/descent/rigid_motion.h"
#include "cpu/elasticity/elastic_energy.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Sides that end a step within so many reaches, and would have pressed each other by themselves, have met.
constexpr double kNear = 2.0;
// What is little of the speed at which two have met.
constexpr double kLeft = 0.1;
// What takes longer is seen: softness, which bounces by itself [s].
constexpr double kLongestImpact = 0.1;
// What bodies give back of their internal energy, to the power of a step over the time that a pressure wave
// takes through them: implicit steps take the rest. Measured with balls that bounce for ever.
constexpr double kGivenBack = 0.03;
// Impulses are repeated until so much of the speed is lacking, or so often.
constexpr double kEnoughRebound = 0.01;
constexpr int kMostPasses = 32;
constexpr std::size_t kPressesATask = 512;

}  // namespace

template <class Real>
struct RigidRebound<Real>::Body {
    RigidInertia inertia;
    glm::dvec3 center{0.0};            // [m]
    Twist before, after, change = {};  // in this step without restitution, and by it
    double pushes = 0.0;               // how many points it is pushed at

    // By how much an impulse changes the velocity along it there [1/kg].
    double yielding(const glm::dvec3& arm, const glm::dvec3& direction) const {
        const glm::dvec3 lever = glm::cross(arm, direction);
        return inertia.inverse_mass + glm::dot(lever, inertia.inverse_inertia * lever);
    }
    Twist change_by(const glm::dvec3& arm, const glm::dvec3& impulse) const {
        return {inertia.inverse_mass * impulse, inertia.inverse_inertia * glm::cross(arm, impulse)};
    }
};

// A touch at which sides are to come apart. Those of null are not bodies that move as a whole.
template <class Real>
struct RigidRebound<Real>::Push {
    std::array<Body*, 2> sides;
    Touch touch;
    double wanted = 0.0;    // [m/s]
    double inertia = 0.0;   // that yields to its impulse [kg]
    double impulse = 0.0;   // [N s]
    double lost = 0.0;      // of the energy with which the sides met [J]
    std::size_t first = 0;  // the number of the first push of this meeting

    // The speed at which the sides come apart. @param twist of a side, which is a body
    double opening(const auto& twist) const {
        std::array<glm::dvec3, 2> velocities = touch.velocities;
        for (std::size_t side = 0; side < 2; ++side)
            if (sides[side] != nullptr) velocities[side] = twist(side).at(touch.points[side]);
        return glm::dot(touch.normal, velocities[1] - velocities[0]);
    }
    double opening_before_pushes() const {
        return opening([&](std::size_t side) { return sides[side]->after; });
    }
    double opening_now() const {
        return opening([&](std::size_t side) { return sides[side]->after + sides[side]->change; });
    }

    void add_impulse(double more) {
        impulse += more;
        for (std::size_t side = 0; side < 2; ++side)
            if (Body* body = sides[side])
                body->change = body->change +
                               body->change_by(touch.points[side], (side == 0 ? -more : more) * touch.normal);
    }
};

template <class Real>
RigidRebound<Real>::RigidRebound(std::shared_ptr<const Model> model, std::span<const double> wave_times)
    : model_(std::move(model)), wave_times_(wave_times) {}

template <class Real>
void RigidRebound<Real>::run(const Step& step, const Contacts<Real>& contacts,
                             const ColliderContacts<Real>& planes, std::span<Vec4<Real>> velocities) {
    Touches touches = find_touches(step, contacts, planes);
    if (touches.empty() && meetings_.empty()) return;
    Bodies bodies = measure(step, touches, contacts, velocities);
    meet(step, std::move(touches), bodies);
    std::vector<Push> pushes = end_meetings(step, contacts, velocities, bodies);
    push_apart(pushes);
    for (std::size_t first = 0, end = 0; first < pushes.size(); first = end) {
        while (end < pushes.size() && pushes[end].first == first) ++end;
        limit_energy(std::span(pushes).subspan(first, end - first));
    }
    for (const auto& [object, body] : bodies) {
        if (body.pushes == 0.0) continue;
        const Range& nodes = model_->objects[object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 change = body.change.at(glm::dvec3(step.positions[n]) - body.center);
            velocities[n] += Vec4<Real>(Vec3<Real>(change), Real(0));
        }
    }
}

// Of what is held, what it does in this step: bodies may be in the way of what moves it.
template <class Real>
Vec3<Real> RigidRebound<Real>::velocity_before(const Step& step, std::uint32_t node) const {
    if (step.positions[node].w > Real(0)) return Vec3<Real>(step.before[node]);
    return (Vec3<Real>(step.positions[node]) - Vec3<Real>(step.starts[node])) /
           static_cast<Real>(step.length);
}

// Objects without these meet nothing faster than the resting speed.
template <class Real>
std::vector<std::uint8_t> RigidRebound<Real>::find_fast(const Step& step) const {
    std::vector<std::uint8_t> is_fast(model_->objects.size());
    const auto least = static_cast<Real>(0.25 * step.resting_speed * step.resting_speed);
    tbb::parallel_for(std::size_t(0), is_fast.size(), [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end() && is_fast[o] == 0; ++n) {
            const Vec3<Real> velocity = velocity_before(step, n);
            if (glm::dot(velocity, velocity) > least) is_fast[o] = 1;
        }
    });
    return is_fast;
}

// Of what has met, or may have.
template <class Real>
typename RigidRebound<Real>::Touches RigidRebound<Real>::find_touches(
    const Step& step, const Contacts<Real>& contacts, const ColliderContacts<Real>& planes) const {
    const std::vector<std::uint8_t> is_fast = find_fast(step);
    const std::vector<Press<Real>>& presses = contacts.aims().presses();
    std::vector<std::vector<std::pair<Pair, Touch>>> found((presses.size() + kPressesATask - 1) /
                                                           kPressesATask);
    for_each_index(0, found.size(), 1, [&](std::size_t task) {
        const std::size_t end = std::min((task + 1) * kPressesATask, presses.size());
        for (std::size_t k = task * kPressesATask; k < end; ++k) {
            const ContactPair& sides = contacts.list().pairs[presses[k].pair];
            const Pair pair{false, sides.object, sides.other};
            const bool may_meet = is_fast[pair.first] != 0 || is_fast[pair.second] != 0;
            if (sides.is_own() || !(may_meet || meetings_.contains(pair))) continue;
            if (contacts.restitution(pair.first, pair.second) == 0.0) continue;
            if (const std::optional<Touch> touch = find_touch(step, contacts, presses[k]))
                found[task].emplace_back(pair, *touch);
        }
    });
    Touches touches;
    for (const auto& of_task : found)
        for (const auto& [pair, touch] : of_task) touches[pair].push_back(touch);
    for (std::uint32_t o = 0; o < model_->body_count(); ++o)
        if (planes.objects[o] != 0 && !planes.nodes.empty())
            add_planes(step, planes, o, is_fast[o] != 0, touches);
    return touches;
}

// None if the sides have not met in the step, nor come near.
template <class Real>
std::optional<typename RigidRebound<Real>::Touch> RigidRebound<Real>::find_touch(
    const Step& step, const Contacts<Real>& contacts, const Press<Real>& press) const {
    const ContactPair& sides = contacts.list().pairs[press.pair];
    const Real gap = contacts.aims().gap(sides, press, step.positions);
    if (!(gap < Real(kNear) * press.reach)) return {};
    Touch touch;
    touch.normal = glm::dvec3(press.normal);
    double kept = 0.0;  // how much smaller the gap would be, had nothing been in the way [m]
    for (std::size_t k = 0; k < 4; ++k) {
        const auto weight = static_cast<double>(press.weights[static_cast<int>(k)]);
        const std::uint32_t n = sides.nodes[k];
        const std::size_t side = sides.side_of(k);
        const glm::dvec3 position(step.positions[n]), velocity(velocity_before(step, n));
        touch.points[side] += weight * position;
        touch.velocities[side] += weight * velocity;
        const glm::dvec3 left = glm::dvec3(step.starts[n]) + step.length * velocity - position;
        kept += (side == 0 ? weight : -weight) * glm::dot(touch.normal, left);
    }
    const bool has_met = static_cast<double>(gap) - kept < static_cast<double>(press.reach);
    if (!has_met && !(gap < press.reach)) return {};
    return touch;
}

template <class Real>
void RigidRebound<Real>::add_planes(const Step& step, const ColliderContacts<Real>& planes,
                                    std::uint32_t object, bool is_fast, Touches& touches) const {
    for (std::uint32_t c = 0; c < model_->colliders.size(); ++c) {
        const Pair pair{true, c, object};
        const Collider& plane = model_->colliders[c];
        if (plane.restitution == 0.0f || !(is_fast || meetings_.contains(pair))) continue;
        const Range& nodes = model_->objects[object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            if (planes.nodes[n].along == Real(0)) continue;
            const SurfaceDistance<Real> surface = surface_distance(plane, Vec3<Real>(step.positions[n]));
            if (surface.distance > static_cast<Real>(kContactDistance)) continue;
            const glm::dvec3 point(step.positions[n]);
            touches[pair].push_back({{point, point}, {}, glm::dvec3(surface.normal)});
        }
    }
}

// Null: a plane, a collider, or a body with held nodes.
template <class Real>
std::array<typename RigidRebound<Real>::Body*, 2> RigidRebound<Real>::sides_of(const Pair& pair,
                                                                               Bodies& bodies) const {
    const auto find = [&](std::uint32_t object) {
        const auto found = bodies.find(object);
        return found == bodies.end() ? nullptr : &found->second;
    };
    return {pair.has_plane ? nullptr : find(pair.first), find(pair.second)};
}

template <class Real>
typename RigidRebound<Real>::Bodies RigidRebound<Real>::measure(
    const Step& step, const Touches& touches, const Contacts<Real>& contacts,
    std::span<const Vec4<Real>> velocities) const {
    Bodies bodies;
    const auto add = [&](const Pair& pair) {
        if (!pair.has_plane && !contacts.is_held(pair.first)) bodies[pair.first];
        if (!contacts.is_held(pair.second)) bodies[pair.second];
    };
    for (const auto& [pair, of_pair] : touches) add(pair);
    for (const auto& [pair, meeting] : meetings_) add(pair);
    std::vector<std::uint32_t> objects;
    for (const auto& [object, body] : bodies) objects.push_back(object);
    tbb::parallel_for(std::size_t(0), objects.size(), [&](std::size_t k) {
        bodies.find(objects[k])->second = measure(step, objects[k], velocities);
    });
    return bodies;
}

template <class Real>
typename RigidRebound<Real>::Body RigidRebound<Real>::measure(const Step& step, std::uint32_t object,
                                                              std::span<const Vec4<Real>> velocities) const {
    const Range& nodes = model_->objects[object].nodes;
    const glm::dvec3 origin(step.positions[nodes.first]);
    RigidSums before;                     // with masses for stiffnesses, and momenta for forces
    glm::dvec3 momentum(0.0), spin(0.0);  // after
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 arm = glm::dvec3(step.positions[n]) - origin;
        const double mass = 1.0 / static_cast<double>(step.positions[n].w);
        before.add(arm, mass, mass * glm::dvec3(step.before[n]));
        const glm::dvec3 own = mass * glm::dvec3(velocities[n]);
        momentum += own;
        spin += glm::cross(arm, own);
    }
    const RigidInertia inertia(before);
    return {inertia, origin + inertia.center, inertia.twist(before.force, before.moment),
            inertia.twist(momentum, spin)};
}

// Where one side does not move as a whole, as seen from there.
template <class Real>
typename RigidRebound<Real>::Energy RigidRebound<Real>::energy_of(const Pair& pair,
                                                                  const std::array<Body*, 2>& sides,
                                                                  std::span<const Touch> touches,
                                                                  const State& state) const {
    Energy energy;
    for (std::size_t side = 0; side < 2; ++side) {
        if (sides[side] == nullptr) continue;
        Twist twist = sides[side]->*state.twist;
        if (sides[1 - side] == nullptr)
            for (const Touch& touch : touches)
                twist.velocity -= touch.velocities[1 - side] / static_cast<double>(touches.size());
        energy.rigid += sides[side]->inertia.energy(twist);
    }
    const auto add = [&](std::uint32_t object, const Body* body) {
        if (object >= model_->body_count()) return;  // a collider's surface
        const double given_back = std::pow(kGivenBack, state.step / wave_times_[object]);
        energy.sum += given_back * internal_energy(object, body, state);
    };
    energy.sum = energy.rigid;
    add(pair.second, sides[1]);
    if (!pair.has_plane) add(pair.first, sides[0]);
    return energy;
}

// @param body null: it does not move as a whole
template <class Real>
double RigidRebound<Real>::internal_energy(std::uint32_t object, const Body* body, const State& state) const {
    double energy = body_energy<Real>(*model_, model_->objects[object], state.positions);
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        if (state.positions[n].w == Real(0)) continue;
        glm::dvec3 velocity(state.velocities[n]);
        if (body != nullptr)
            velocity -= (body->*state.twist).at(glm::dvec3(state.positions[n]) - body->center);
        energy += 0.5 * static_cast<double>(model_->masses[n]) * glm::dot(velocity, velocity);
    }
    return energy;
}

// Meetings begin where two press each other that came together faster than the resting speed, and again where
// they come together faster than they had met.
template <class Real>
void RigidRebound<Real>::meet(const Step& step, Touches touches, Bodies& bodies) {
    for (auto& [pair, meeting] : meetings_) meeting.age += step.length;
    for (auto& [pair, of_pair] : touches) {
        const std::array<Body*, 2> sides = sides_of(pair, bodies);
        double approach = 0.0;
        for (Touch& touch : of_pair) {
            for (std::size_t side = 0; side < 2; ++side)
                if (sides[side] != nullptr) touch.points[side] -= sides[side]->center;
            const Push push{sides, touch};
            approach =
                std::max(approach, -push.opening([&](std::size_t side) { return sides[side]->before; }));
        }
        const auto known = meetings_.find(pair);
        const bool is_known = known != meetings_.end();
        if (approach > (is_known ? known->second.approach : step.resting_speed)) {
            std::array<Twist, 2> twists;
            for (std::size_t side = 0; side < 2; ++side)
                if (sides[side] != nullptr) twists[side] = sides[side]->before;
            const Energy energy =
                energy_of(pair, sides, of_pair, {step.length, step.starts, step.before, &Body::before});
            meetings_[pair] = {twists, energy, approach, approach, step.length, std::move(of_pair), true};
        } else if (is_known) {
            known->second.latest_approach = approach;
            known->second.touches = std::move(of_pair);
            known->second.presses = true;
        }
    }
}

// As if each point had bodies of its own, with their part of the mass (mass splitting, Tonge et al. 2012):
// all may be pushed at once.
template <class Real>
void RigidRebound<Real>::push_apart(std::vector<Push>& pushes) {
    for (const Push& push : pushes)
        for (Body* side : push.sides)
            if (side != nullptr) side->pushes += 1.0;
    for (Push& push : pushes) {
        double yielding = 0.0;
        for (std::size_t side = 0; side < 2; ++side)
            if (const Body* body = push.sides[side])
                yielding += body->pushes * body->yielding(push.touch.points[side], push.touch.normal);
        push.inertia = yielding > 0.0 ? 1.0 / yielding : 0.0;
    }
    bool lacks = true;
    for (int pass = 0; pass < kMostPasses && lacks; ++pass) {
        lacks = false;
        std::vector<double> changes;  // of impulses
        for (Push& push : pushes) {
            const double lacking = push.wanted - push.opening_now();
            changes.push_back(std::max(lacking * push.inertia, -push.impulse));
            lacks = lacks || lacking > kEnoughRebound * push.wanted;
        }
        for (std::size_t k = 0; k < pushes.size(); ++k) pushes[k].add_impulse(changes[k]);
    }
}

// Impulses times s add s sum_k j_k u_k + s^2 / 2 sum_k j_k (u'_k - u_k), with the speeds u of separation
// before them and u' after them. Soft bodies have bounced by themselves, or will, and turned since they met.
template <class Real>
void RigidRebound<Real>::limit_energy(std::span<Push> of_meeting) {
    double linear = 0.0, square = 0.0;
    for (const Push& push : of_meeting) {
        const double before = push.opening_before_pushes();
        linear += push.impulse * before;
        square += 0.5 * push.impulse * (push.opening_now() - before);
    }
    const double most = of_meeting.front().lost;
    if (!(linear + square > most) || !(square > 0.0)) return;
    const double part = (std::sqrt(linear * linear + 4.0 * square * most) - linear) / (2.0 * square);
    for (Push& push : of_meeting) push.add_impulse((std::clamp(part, 0.0, 1.0) - 1.0) * push.impulse);
}

// An impact is over where two hardly approach any more, and what they press each other with would hardly
// throw them apart while a pressure wave passes. Those that approach, but do not press each other in a step,
// are in the middle of it: surfaces of soft bodies bounce by themselves.
template <class Real>
bool RigidRebound<Real>::is_over(const Step& step, const Meeting& meeting, const std::array<Body*, 2>& sides,
                                 bool presses, double wave_time) const {
    double before = 0.0, after = 0.0;
    for (const Touch& touch : meeting.touches) {
        const Push push{sides, touch};
        before += push.opening([&](std::size_t side) { return sides[side]->before; });
        after += push.opening([&](std::size_t side) { return sides[side]->after; });
    }
    const double little = kLeft * meeting.approach * static_cast<double>(meeting.touches.size());
    return after > -little && (!presses || (after - before) * wave_time < little * step.length);
}

// So that impulses keep angular momentum.
template <class Real>
void RigidRebound<Real>::meet_in_one_point(Push& push) {
    const auto [first, second] = push.sides;
    if (first == nullptr || second == nullptr) return;
    std::array<glm::dvec3, 2>& arms = push.touch.points;
    const glm::dvec3 point = 0.5 * (first->center + arms[0] + second->center + arms[1]);
    arms = {point - first->center, point - second->center};
}

// Those of two that have left each other, or whose impact is over. Of long ones nothing is left to do, but
// they are no new ones while the two go on to approach.
template <class Real>
std::vector<typename RigidRebound<Real>::Push> RigidRebound<Real>::end_meetings(
    const Step& step, const Contacts<Real>& contacts, std::span<const Vec4<Real>> velocities,
    Bodies& bodies) {
    std::vector<Push> pushes;
    for (auto next = meetings_.begin(); next != meetings_.end();) {
        const Pair& pair = next->first;
        Meeting& meeting = next->second;
        const std::array<Body*, 2> sides = sides_of(pair, bodies);
        const bool presses = std::exchange(meeting.presses, false), is_short = meeting.age < kLongestImpact;
        const double wave_time =
            std::max(pair.has_plane ? 0.0 : wave_times_[pair.first], wave_times_[pair.second]);
        const bool goes_on = is_short ? !is_over(step, meeting, sides, presses, wave_time)
                                      : presses && meeting.latest_approach > step.resting_speed;
        if (goes_on) {
            ++next;
            continue;
        }
        if (is_short) {
            const double restitution = pair.has_plane
                                           ? static_cast<double>(model_->colliders[pair.first].restitution)
                                           : contacts.restitution(pair.first, pair.second);
            const Energy energy = energy_of(pair, sides, meeting.touches,
                                            {step.length, step.positions, velocities, &Body::after});
            const std::size_t first = pushes.size();
            for (const Touch& touch : meeting.touches) {
                Push push{sides, touch};
                push.lost = std::max(
                    std::min(meeting.energy.rigid - energy.rigid, meeting.energy.sum - energy.sum), 0.0);
                push.first = first;
                push.wanted =
                    -restitution * push.opening([&](std::size_t side) { return meeting.twists[side]; });
                if (!(push.wanted > 0.0)) continue;
                meet_in_one_point(push);
                pushes.push_back(push);
            }
        }
        next = meetings_.erase(next);
    }
    return pushes;
}

template class RigidRebound<float>;
template class RigidRebound<double>;

}  // namespace gelatin::cpu
