#include "cpu/descent/tangled_bodies.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/descent/rigid_inertia.h"
#include "cpu/elasticity/elastic_energy.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// A guess that tangles a body makes more than this part of its way, or nothing.
constexpr double kLeastOfGuess = 0.1;

}  // namespace

template <class Real>
void TangledBodies<Real>::shorten_guess(const StepObjective<Real>& objective,
                                        std::span<const std::uint8_t> may_be_part,
                                        std::vector<Vec4<Real>>& positions) {
    for_each_index(0, model_->objects.size(), 1, [&](std::size_t o) {
        const ModelObject& object = model_->objects[o];
        is_tangled_[o] = 0;
        if (!objective.is_tangled(object, positions)) return;
        const std::vector<Vec4<Real>> guess(positions.begin() + object.nodes.first,
                                            positions.begin() + object.nodes.end());
        const auto go = [&](double part) {
            for (std::uint32_t k = 0; k < object.nodes.count; ++k) {
                const std::uint32_t n = object.nodes.first + k;
                if (positions[n].w == Real(0)) continue;  // held ones are where their handle takes them
                const Vec3<Real> start(objective.step.starts[n]), way = Vec3<Real>(guess[k]) - start;
                positions[n] = Vec4<Real>(start + static_cast<Real>(part) * way, positions[n].w);
            }
        };
        go(0.0);
        is_tangled_[o] = objective.is_tangled(object, positions) ? 1 : 0;
        if (may_be_part[o] == 0) return;
        const double at_start = objective_of(objective, object, positions);
        for (double part = 1.0; part > kLeastOfGuess; part *= 0.5) {
            go(part);
            if (objective_of(objective, object, positions) <= at_start) return;
        }
        go(0.0);
    });
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
