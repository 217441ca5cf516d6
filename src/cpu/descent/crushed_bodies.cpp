#include "cpu/descent/crushed_bodies.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cpu/elasticity/elastic_energy.h"

namespace gelatin::cpu {

template <class Real>
double body_energy(const Model& model, const ModelObject& object, std::span<const Vec4<Real>> positions) {
    const double energy =
        elastic_energy<Real>(model, {object.nodes, object.springs, object.neo_hookean_tets}, positions);
    const bool has_flat_tets = object.neo_hookean_tets.count == 0;
    return has_flat_tets ? energy + flat_tet_energy<Real>(model, object.tets, positions) : energy;
}

template <class Real>
void CrushedBodies<Real>::run(const Step& step, std::span<const std::uint32_t> objects,
                              std::span<Vec4<Real>> velocities) const {
    tbb::parallel_for(std::size_t(0), objects.size(),
                      [&](std::size_t k) { slow_down(step, model_->objects[objects[k]], velocities); });
}

template <class Real>
void CrushedBodies<Real>::slow_down(const Step& step, const ModelObject& object,
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
        kinetic([&](std::uint32_t n) { return glm::dvec3(step.before[n]); }) + sum([&](std::uint32_t n) {
            glm::dvec3 force = mass_of(n) * glm::dvec3(model_->gravity) + step.contacts.normal[n] +
                               step.contacts.friction[n];
            if (!step.load_forces.empty()) force += glm::dvec3(step.load_forces[n]);
            return glm::dot(force, glm::dvec3(step.positions[n]) - glm::dvec3(step.starts[n]));
        });
    const double energy = given + body_energy<Real>(*model_, object, step.starts) -
                          body_energy<Real>(*model_, object, step.positions);
    if (kinetic(velocity_after) <= energy) return;

    const double mass = sum(mass_of);
    const glm::dvec3 velocity = sum([&](std::uint32_t n) { return mass_of(n) * velocity_after(n); }) / mass;
    const glm::dvec3 first(step.positions[nodes.first]);
    const auto from_first = [&](std::uint32_t n) { return glm::dvec3(step.positions[n]) - first; };
    const glm::dvec3 center = sum([&](std::uint32_t n) { return mass_of(n) * from_first(n); }) / mass;
    const auto arm = [&](std::uint32_t n) { return from_first(n) - center; };
    const glm::dvec3 spin =
        sum([&](std::uint32_t n) { return mass_of(n) * glm::cross(arm(n), velocity_after(n) - velocity); });
    const glm::dmat3 inertia = sum([&](std::uint32_t n) {
        constexpr double kThin = 1e-6;  // a row of nodes has no inertia about itself
        const glm::dvec3 r = arm(n);
        return mass_of(n) * ((1.0 + kThin) * glm::dot(r, r) * glm::dmat3(1.0) - glm::outerProduct(r, r));
    });
    const glm::dvec3 rotation = glm::inverse(inertia) * spin;
    const auto rigid = [&](std::uint32_t n) { return velocity + glm::cross(rotation, arm(n)); };
    const double besides = kinetic([&](std::uint32_t n) { return velocity_after(n) - rigid(n); });
    if (!(besides > 0.0)) return;
    const double part = std::sqrt(std::clamp((energy - kinetic(rigid)) / besides, 0.0, 1.0));
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 slower = rigid(n) + part * (velocity_after(n) - rigid(n));
        velocities[n] = Vec4<Real>(Vec3<Real>(slower), velocities[n].w);
    }
}

template double body_energy<float>(const Model&, const ModelObject&, std::span<const Vec4<float>>);
template double body_energy<double>(const Model&, const ModelObject&, std::span<const Vec4<double>>);
template class CrushedBodies<float>;
template class CrushedBodies<double>;

}  // namespace gelatin::cpu
