#include "cpu/implicit/time_scheme.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "core/disjoint_sets.h"
#include "cpu/contact/tuning.h"
#include "cpu/implicit/rigid_inertia.h"
#include "model/elasticity/wave_times.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
TimeScheme<Real>::TimeScheme(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      schemes_(model_->objects.size()),
      tied_(model_->body_count()),
      began_(model_->body_count()),
      rates_(model_->body_count()) {
    forget();
    for (const double time : wave_times(*model_)) wave_times_.push_back(static_cast<Real>(time));
}

template <class Real>
void TimeScheme<Real>::forget() {
    last_step_ = Real(0);
    std::iota(tied_.begin(), tied_.end(), 0u);
    next_tied_ = tied_;
}

template <class Real>
void TimeScheme<Real>::tie(std::span<const std::uint32_t> islands_of_bodies,
                           std::span<const std::uint8_t> whole) {
    std::vector<std::uint8_t> any_euler(tied_.size()), differ(tied_.size());
    for (std::size_t o = 0; o < tied_.size(); ++o) {
        const Scheme &own = schemes_[o], &first = schemes_[tied_[o]];
        if (own.past == Real(0)) any_euler[tied_[o]] = 1;
        if (own.past != first.past || own.alpha != first.alpha) differ[tied_[o]] = 1;
    }
    DisjointSets sets(tied_.size());
    for (std::uint32_t o = 0; o < tied_.size(); ++o) {
        const std::uint32_t least = tied_[o];
        schemes_[o].is_whole = whole[islands_of_bodies[o]] != 0 || differ[least] != 0;
        if (any_euler[least] == 0) sets.unite(o, least);
        sets.unite(o, islands_of_bodies[o]);
    }
    for (std::uint32_t o = 0; o < tied_.size(); ++o) next_tied_[o] = sets.least(o);
}

template <class Real>
typename TimeScheme<Real>::Scheme TimeScheme<Real>::of_momenta(std::size_t body) const {
    const Scheme& s = schemes_[body];
    return s.is_whole ? Scheme{.length = s.length, .step = s.length} : s;
}

template <class Real>
void TimeScheme<Real>::archive(Archive& archive) {
    archive.value(last_step_);
    archive.list(accelerations_);
    archive.array(rates_);
    archive.array(tied_);
    if (has_past() && accelerations_.size() != model_->node_count()) archive.fail();
    for (std::uint32_t o = 0; o < tied_.size(); ++o)
        if (tied_[o] > o) return archive.fail();
}

template <class Real>
void TimeScheme<Real>::go_on(const Nodes<Real>& nodes, std::span<const Vec4<Real>> earlier_velocities,
                             Real step) {
    begin({nodes.positions, {earlier_velocities.begin(), earlier_velocities.end()}});
    for (std::size_t o = 0; o < schemes_.size(); ++o) set(o, step, Real(0));
    end({nodes.positions, {earlier_velocities.begin(), earlier_velocities.end()}}, nodes);
}

template <class Real>
void TimeScheme<Real>::begin(const Nodes<Real>& previous) {
    for_each_index(0, began_.size(), 1,
                   [&](std::size_t o) { began_[o] = moving(o, previous.positions, previous.velocities); });
}

// Accelerations are those that velocities have changed by, whatever did it.
template <class Real>
void TimeScheme<Real>::end(const Nodes<Real>& previous, const Nodes<Real>& current) {
    accelerations_.resize(current.positions.size(), Vec3<Real>(0));
    for_each_index(accelerations_.size(), [&](std::size_t n) {
        const Scheme& s = schemes_[model_->node_objects[n]];
        const Vec3<Real> change(current.velocities[n] - previous.velocities[n]),
            before = s.past * (Real(1) - s.gamma) * accelerations_[n];
        accelerations_[n] = (change / s.length - before) / s.gamma;
    });
    for_each_index(0, began_.size(), 1, [&](std::size_t o) {
        const Scheme s = of_momenta(o);
        const Momenta now = moving(o, current.positions, current.velocities).momenta, before = rates_[o];
        const auto rate = [&](glm::dvec3 Momenta::*part) {
            return ((now.*part - began_[o].momenta.*part) / static_cast<double>(s.length) -
                    static_cast<double>(s.past * (Real(1) - s.gamma)) * (before.*part)) /
                   static_cast<double>(s.gamma);
        };
        rates_[o] = {rate(&Momenta::linear), rate(&Momenta::angular)};
    });
    last_step_ = schemes_[0].length;
    tied_ = next_tied_;
}

template <class Real>
void TimeScheme<Real>::set(std::size_t object, Real step, Real damping) {
    schemes_[object] = {.length = step, .step = step, .damping = damping};
}

template <class Real>
void TimeScheme<Real>::set_second_order(std::size_t object, Real step, double left) {
    const auto alpha = static_cast<Real>((1.0 - left) / (1.0 + left));
    schemes_[object] = {.length = step,
                        .step = Real(0.5) * step * std::sqrt(Real(1) + alpha),
                        .past = Real(1),
                        .alpha = alpha,
                        .beta = Real(0.25) * (Real(1) + alpha) * (Real(1) + alpha),
                        .gamma = Real(0.5) + alpha};
}

template <class Real>
Vec3<Real> TimeScheme<Real>::target(const Nodes<Real>& previous, std::size_t node,
                                    const Vec3<Real>& acceleration) const {
    const Scheme& s = schemes_[model_->node_objects[node]];
    const Vec3<Real> target =
        s.length * Vec3<Real>(previous.velocities[node]) + s.step * s.step * acceleration;
    return s.past > Real(0)
               ? target + Real(0.25) * (Real(1) - s.alpha) * s.length * s.length * accelerations_[node]
               : target;
}

template <class Real>
Vec3<Real> TimeScheme<Real>::velocity(const Nodes<Real>& previous, std::size_t node,
                                      const Vec3<Real>& displacement) const {
    const Scheme& s = schemes_[model_->node_objects[node]];
    const Real h = s.length;
    if (s.past == Real(0)) return displacement / h;
    const Vec3<Real> v(previous.velocities[node]), before = accelerations_[node];
    const Vec3<Real> now = (displacement - h * v - (Real(0.5) - s.beta) * h * h * before) / (s.beta * h * h);
    return v + h * ((Real(1) - s.gamma) * before + s.gamma * now);
}

// As steps have it, in which a node is what its inverse mass says; of held nodes, which have none, too: their
// body may be let go, and what it had then counts.
template <class Real>
double TimeScheme<Real>::mass_of(std::size_t node, const Vec4<Real>& position) const {
    return position.w > Real(0) ? 1.0 / static_cast<double>(position.w)
                                : static_cast<double>(model_->masses[node]);
}

template <class Real>
typename TimeScheme<Real>::Moving TimeScheme<Real>::moving(std::size_t body,
                                                           std::span<const Vec4<Real>> positions,
                                                           std::span<const Vec4<Real>> velocities) const {
    const Range& nodes = model_->objects[body].nodes;
    const glm::dvec3 origin(positions[nodes.first]);
    glm::dvec3 middle(0.0), momentum(0.0), angular(0.0);
    double mass = 0.0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const double m = mass_of(n, positions[n]);
        const glm::dvec3 r = glm::dvec3(positions[n]) - origin, v(velocities[n]);
        mass += m;
        middle += m * r;
        momentum += m * v;
        angular += m * glm::cross(r, v);
    }
    middle /= mass;
    return {{momentum, angular - glm::cross(middle, momentum)}, origin + middle, mass};
}

template <class Real>
void TimeScheme<Real>::Moving::add(const Moving& more) {
    const glm::dvec3 middle = (mass * center + more.mass * more.center) / (mass + more.mass);
    momenta.angular += glm::cross(center - middle, momenta.linear) + more.momenta.angular +
                       glm::cross(more.center - middle, more.momenta.linear);
    momenta.linear += more.momenta.linear;
    center = middle;
    mass += more.mass;
}

template <class Real>
void TimeScheme<Real>::keep_momenta(const RigidLevel<Real>& rigid, std::span<const std::uint32_t> groups,
                                    std::span<const Vec3<Real>> forces, Nodes<Real>& current) const {
    std::vector<std::vector<std::uint32_t>> members(groups.size());
    for (std::uint32_t o = 0; o < groups.size(); ++o)
        if (rigid.is_free(o)) members[groups[o]].push_back(o);
    for_each_index(0, members.size(), 1, [&](std::size_t g) {
        const std::vector<std::uint32_t>& bodies = members[g];
        if (bodies.empty()) return;
        const glm::dvec3 origin(current.positions[model_->objects[bodies[0]].nodes.first]);
        RigidSums sums;
        Moving had, has;
        Momenta before;  // how fast they changed
        const auto for_nodes = [&](const auto& visit) {
            for (const std::uint32_t o : bodies)
                for (std::uint32_t n = model_->objects[o].nodes.first; n < model_->objects[o].nodes.end();
                     ++n)
                    visit(n);
        };
        for_nodes([&](std::uint32_t n) {
            sums.add(glm::dvec3(current.positions[n]) - origin, mass_of(n, current.positions[n]),
                     glm::dvec3(forces[n]));
        });
        for (const std::uint32_t o : bodies) {
            had.add(began_[o]);
            has.add(moving(o, current.positions, current.velocities));
        }
        for (const std::uint32_t o : bodies) {
            before.linear += rates_[o].linear;
            before.angular += rates_[o].angular + glm::cross(began_[o].center - had.center, rates_[o].linear);
        }
        const RigidInertia inertia(sums);
        const Scheme s = of_momenta(bodies[0]);
        const auto h = static_cast<double>(s.length), past = static_cast<double>(s.past),
                   alpha = static_cast<double>(s.alpha), gamma = static_cast<double>(s.gamma);
        const glm::dvec3 weight = glm::dvec3(model_->gravity) / inertia.inverse_mass;
        const Momenta forces_now{sums.force + weight, sums.moment - glm::cross(inertia.center, sums.force)};
        const auto lacking = [&](glm::dvec3 Momenta::*part) {
            const glm::dvec3 now = (forces_now.*part + past * alpha * before.*part) / (1.0 + alpha);
            return had.momenta.*part + h * (past * (1.0 - gamma) * before.*part + gamma * now) -
                   has.momenta.*part;
        };
        const Twist missing{inertia.inverse_mass * lacking(&Momenta::linear),
                            inertia.inverse_inertia * lacking(&Momenta::angular)};
        for_nodes([&](std::uint32_t n) {
            const glm::dvec3 r = glm::dvec3(current.positions[n]) - origin - inertia.center;
            current.velocities[n] += Vec4<Real>(Vec3<Real>(missing.at(r)), 0);
        });
    });
}

template class TimeScheme<float>;
template class TimeScheme<double>;

}  // namespace gelatin::cpu
