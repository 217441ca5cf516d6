#include "cpu/descent/tangled_bodies.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/descent/rigid_inertia.h"
#include "cpu/descent/rigid_nodes.h"
#include "cpu/elasticity/elastic_energy.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// A guess that tangles a body makes more than this part of its way, or nothing.
constexpr double kLeastOfGuess = 0.1;

}  // namespace

template <class Real>
void TangledBodies<Real>::shorten_guess(const StepObjective<Real>& objective,
                                        std::span<const GuessLimit> limits,
                                        std::vector<Vec4<Real>>& positions) {
    for_each_index(0, model_->objects.size(), 1, [&](std::size_t o) {
        const ModelObject& object = model_->objects[o];
        const Range& nodes = object.nodes;
        const bool tangles = objective.is_tangled(object, positions);
        is_tangled_[o] = 0;
        if (!tangles && limits[o] != GuessLimit::energy) return;
        const std::span<Vec4<Real>> own = std::span(positions).subspan(nodes.first, nodes.count);
        const std::vector<Vec4<Real>> guess(own.begin(), own.end());
        for (std::uint32_t k = 0; k < nodes.count; ++k)  // held ones are where their handle takes them
            if (own[k].w > Real(0))
                own[k] = Vec4<Real>(Vec3<Real>(objective.step.starts[nodes.first + k]), own[k].w);
        if (tangles) is_tangled_[o] = objective.is_tangled(object, positions) ? 1 : 0;
        if (limits[o] == GuessLimit::all) return;
        move_on_rigidly(objective, nodes, own);
        const std::vector<Vec4<Real>> rigid(own.begin(), own.end());
        const double most = objective_of(objective, object, positions);
        for (double part = 1.0; part > kLeastOfGuess; part *= 0.5) {
            for (std::uint32_t k = 0; k < nodes.count; ++k)
                own[k] = rigid[k] + static_cast<Real>(part) * (guess[k] - rigid[k]);
            if (objective_of(objective, object, positions) <= most) return;
        }
        std::copy(rigid.begin(), rigid.end(), own.begin());
    });
}

// As near to the targets as that takes a body, where nothing holds it.
template <class Real>
void TangledBodies<Real>::move_on_rigidly(const StepObjective<Real>& objective, const Range& nodes,
                                          std::span<Vec4<Real>> positions) const {
    const auto is_held = [](const Vec4<Real>& p) { return p.w == Real(0); };
    if (std::any_of(positions.begin(), positions.end(), is_held)) return;
    const glm::dvec3 origin(positions.front());
    RigidStep motion;
    motion.add(sum_rigid_nodes(
        std::span<const Vec4<Real>>(positions),
        std::span<const Vec4<Real>>(objective.step.targets).subspan(nodes.first, nodes.count), origin));
    move_rigid_nodes(motion.solve(origin), positions);
}

// Of a body by itself [J].
template <class Real>
double TangledBodies<Real>::objective_of(const StepObjective<Real>& objective, const ModelObject& object,
                                         const std::vector<Vec4<Real>>& positions) const {
    double energy = body_energy<Real>(*model_, object, positions);
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        const Vec4<Real>& target = objective.step.targets[n];
        const glm::dvec3 left = glm::dvec3(positions[n]) - glm::dvec3(target);
        energy += 0.5 * static_cast<double>(target.w) * glm::dot(left, left);
    }
    return energy;
}

template <class Real>
void TangledBodies<Real>::move_rigidly(std::uint32_t object, std::span<const Vec4<Real>> shape,
                                       Nodes<Real>& nodes) const {
    const Range& range = model_->objects[object].nodes;
    const glm::dvec3 origin(nodes.positions[range.first]);
    RigidSums had, has;  // with masses for stiffnesses, and momenta for forces
    for (std::uint32_t n = range.first; n < range.end(); ++n) {
        const auto mass = static_cast<double>(model_->masses[n]);
        had.add(glm::dvec3(shape[n]) - origin, mass, mass * glm::dvec3(nodes.velocities[n]));
        has.add(glm::dvec3(nodes.positions[n]) - origin, mass, glm::dvec3(0.0));
    }
    const RigidInertia inertia(has);
    const glm::dvec3 spin = had.moment - glm::cross(RigidInertia(had).center, had.force);
    const Twist twist{inertia.inverse_mass * had.force, inertia.inverse_inertia * spin};
    for (std::uint32_t n = range.first; n < range.end(); ++n) {
        const glm::dvec3 arm = glm::dvec3(nodes.positions[n]) - origin - inertia.center;
        nodes.velocities[n] = Vec4<Real>(Vec3<Real>(twist.at(arm)), nodes.velocities[n].w);
    }
}

template <class Real>
void TangledBodies<Real>::slow_down(const End& end, std::span<const std::uint32_t> objects,
                                    std::span<Vec4<Real>> velocities) const {
    tbb::parallel_for(std::size_t(0), objects.size(),
                      [&](std::size_t k) { slow_down(end, model_->objects[objects[k]], velocities); });
}

template <class Real>
void TangledBodies<Real>::slow_down(const End& end, const ModelObject& object,
                                    std::span<Vec4<Real>> velocities) const {
    const Range& nodes = object.nodes;
    const auto mass_of = [&](std::uint32_t n) { return static_cast<double>(model_->masses[n]); };
    const auto sum = [&](const auto& value) {
        auto all = value(nodes.first);
        for (std::uint32_t n = nodes.first + 1; n < nodes.end(); ++n) all += value(n);
        return all;
    };
    const auto kinetic = [&](const auto& velocity) {
        return sum([&](std::uint32_t n) {
            const glm::dvec3 v = velocity(n);
            return 0.5 * mass_of(n) * glm::dot(v, v);
        });
    };
    const auto velocity_after = [&](std::uint32_t n) { return glm::dvec3(velocities[n]); };
    const double given =
        kinetic([&](std::uint32_t n) { return glm::dvec3(end.before[n]); }) + sum([&](std::uint32_t n) {
            glm::dvec3 force =
                mass_of(n) * glm::dvec3(model_->gravity) + end.contacts.normal[n] + end.contacts.friction[n];
            if (!end.load_forces.empty()) force += glm::dvec3(end.load_forces[n]);
            return glm::dot(force, glm::dvec3(end.positions[n]) - glm::dvec3(end.starts[n]));
        });
    const double energy = given + body_energy<Real>(*model_, object, end.starts) -
                          body_energy<Real>(*model_, object, end.positions);
    if (kinetic(velocity_after) <= energy) return;

    const glm::dvec3 origin(end.positions[nodes.first]);
    const auto arm = [&](std::uint32_t n) { return glm::dvec3(end.positions[n]) - origin; };
    RigidSums sums;  // with masses for stiffnesses, and momenta for forces
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        sums.add(arm(n), mass_of(n), mass_of(n) * velocity_after(n));
    const RigidInertia inertia(sums);
    const Twist twist = inertia.twist(sums.force, sums.moment);
    const auto rigid = [&](std::uint32_t n) { return twist.at(arm(n) - inertia.center); };
    const double besides = kinetic([&](std::uint32_t n) { return velocity_after(n) - rigid(n); });
    if (!(besides > 0.0)) return;
    const double part = std::sqrt(std::clamp((energy - kinetic(rigid)) / besides, 0.0, 1.0));
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 slower = rigid(n) + part * (velocity_after(n) - rigid(n));
        velocities[n] = Vec4<Real>(Vec3<Real>(slower), velocities[n].w);
    }
}

template class TangledBodies<float>;
template class TangledBodies<double>;

}  // namespace gelatin::cpu
