#include "cpu/implicit/time_scheme.h"

#include <glm/geometric.hpp>
#include <utility>

#include "cpu/descent/rigid_inertia.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// BDF2 is stable for steps up to 2.4 times as long as the last one.
constexpr double kLongest = 2.2;

}  // namespace

template <class Real>
TimeScheme<Real>::TimeScheme(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      object_of_(objects_of_nodes(*model_)),
      schemes_(model_->objects.size()),
      momenta_(model_->body_count()),
      earlier_momenta_(model_->body_count()) {}

template <class Real>
void TimeScheme<Real>::archive(Archive& archive) {
    archive.value(last_step_);
    archive.list(earlier_velocities_);
    archive.array(momenta_);
    if (last_step_ > Real(0) && earlier_velocities_.size() != model_->node_count()) archive.fail();
}

template <class Real>
void TimeScheme<Real>::go_on(const Nodes<Real>& nodes, std::span<const Vec4<Real>> earlier_velocities,
                             Real step) {
    earlier_velocities_.assign(earlier_velocities.begin(), earlier_velocities.end());
    last_step_ = step;
    std::vector<Vec4<Real>> earlier = nodes.positions;
    for (std::size_t n = 0; n < earlier.size(); ++n) earlier[n] -= Vec4<Real>(went(nodes, n), 0);
    for (std::size_t o = 0; o < momenta_.size(); ++o) momenta_[o] = momenta(o, earlier, earlier_velocities);
}

template <class Real>
void TimeScheme<Real>::begin(const Nodes<Real>& previous) {
    earlier_momenta_ = momenta_;
    for (std::size_t o = 0; o < momenta_.size(); ++o)
        momenta_[o] = momenta(o, previous.positions, previous.velocities);
}

template <class Real>
void TimeScheme<Real>::end(const Nodes<Real>& previous, Real step) {
    earlier_velocities_ = previous.velocities;
    last_step_ = step;
}

template <class Real>
bool TimeScheme<Real>::can_go_on(Real step) const {
    return last_step_ > Real(0) && step < static_cast<Real>(kLongest) * last_step_;
}

template <class Real>
void TimeScheme<Real>::set(std::size_t object, Real step, bool goes_on, Real damping) {
    const Real ratio = goes_on ? step / last_step_ : Real(0);
    schemes_[object] = {ratio * ratio / (Real(1) + Real(2) * ratio),
                        step * (Real(1) + ratio) / (Real(1) + Real(2) * ratio), damping};
}

// s
template <class Real>
Vec3<Real> TimeScheme<Real>::went(const Nodes<Real>& previous, std::size_t node) const {
    return Real(0.5) * last_step_ *
           (Vec3<Real>(previous.velocities[node]) + Vec3<Real>(earlier_velocities_[node]));
}

template <class Real>
Vec3<Real> TimeScheme<Real>::target(const Nodes<Real>& previous, std::size_t node,
                                    const Vec3<Real>& acceleration) const {
    const auto& [past, h, damping] = schemes_[object_of_[node]];
    const Vec3<Real> v(previous.velocities[node]);
    Vec3<Real> target = h * v + h * h * acceleration;
    if (past > Real(0))
        target += past * (went(previous, node) + h * (v - Vec3<Real>(earlier_velocities_[node])));
    return target;
}

template <class Real>
Vec3<Real> TimeScheme<Real>::velocity(const Nodes<Real>& previous, std::size_t node,
                                      const Vec3<Real>& displacement) const {
    const auto& [past, h, damping] = schemes_[object_of_[node]];
    Vec3<Real> velocity = displacement / h;
    if (past > Real(0)) velocity -= past / h * went(previous, node);
    return velocity;
}

// As steps have it, in which a node is what its inverse mass says; of held nodes, which have none, too: their
// body may be let go, and what it had then counts.
template <class Real>
double TimeScheme<Real>::mass_of(std::size_t node, const Vec4<Real>& position) const {
    return position.w > Real(0) ? 1.0 / static_cast<double>(position.w)
                                : static_cast<double>(model_->masses[node]);
}

template <class Real>
typename TimeScheme<Real>::Momenta TimeScheme<Real>::momenta(std::size_t body,
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
    return {momentum, angular - glm::cross(middle, momentum) / mass};
}

template <class Real>
void TimeScheme<Real>::keep_momenta(const RigidLevel<Real>& rigid, std::span<const Vec3<Real>> forces,
                                    Nodes<Real>& current) const {
    for_each_index(0, momenta_.size(), 1, [&](std::size_t o) {
        if (!rigid.is_free(o)) return;
        const Range& nodes = model_->objects[o].nodes;
        const glm::dvec3 origin(current.positions[nodes.first]);
        RigidSums sums;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sums.add(glm::dvec3(current.positions[n]) - origin, mass_of(n, current.positions[n]),
                     glm::dvec3(forces[n]));
        const RigidInertia inertia(sums);
        const auto h = static_cast<double>(schemes_[o].step), past = static_cast<double>(schemes_[o].past);
        const Momenta change{sums.force + glm::dvec3(model_->gravity) / inertia.inverse_mass,
                             sums.moment - glm::cross(inertia.center, sums.force)};
        const Momenta &had = momenta_[o], &earlier = earlier_momenta_[o];
        const Momenta has = momenta(o, current.positions, current.velocities);
        const auto lacking = [&](glm::dvec3 Momenta::*part) {
            return had.*part + past * (had.*part - earlier.*part) + h * change.*part - has.*part;
        };
        const Twist missing{inertia.inverse_mass * lacking(&Momenta::linear),
                            inertia.inverse_inertia * lacking(&Momenta::angular)};
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 r = glm::dvec3(current.positions[n]) - origin - inertia.center;
            current.velocities[n] += Vec4<Real>(Vec3<Real>(missing.at(r)), 0);
        }
    });
}

template class TimeScheme<float>;
template class TimeScheme<double>;

}  // namespace gelatin::cpu
