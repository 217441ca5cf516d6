#include "cpu/elasticity/elastic_energy.h"

#include <cstdint>
#include <numeric>
#include <vector>

#include "cpu/elasticity/neo_hookean.h"
#include "cpu/elasticity/volume_ratios.h"
#include "cpu/elasticity/volume_term.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kElementsATask = 4096;

// Of equal shares of a range, that of a task.
Range share_of(const Range& all, std::uint32_t task, std::uint32_t tasks) {
    const auto start = [&](std::uint64_t k) { return static_cast<std::uint32_t>(k * all.count / tasks); };
    return {all.first + start(task), start(task + 1) - start(task)};
}

// The energy of the volume term around one node [J].
template <class Position>
double volume_energy(const VolumeTerm& term, std::uint32_t n, const Position& position) {
    const glm::dvec2 node(term.nodes[n]);
    return node.x * node.y * volume_potential(volume_ratio_round<double>(term, n, position), node.y);
}

}  // namespace

template <class Real>
double elastic_energy(const Model& model, const ElasticParts& parts, std::span<const Vec4<Real>> positions) {
    const auto position = [&](std::uint32_t n) { return glm::dvec3(positions[n]); };
    double energy = 0.0;
    if (!model.volume_term.is_empty())
        for (std::uint32_t n = parts.nodes.first; n < parts.nodes.end(); ++n)
            energy += volume_energy(model.volume_term, n, position);
    for (std::uint32_t s = parts.springs.first; s < parts.springs.end(); ++s) {
        const Spring& spring = model.springs[s];
        const SpringLaw<double> law{static_cast<double>(spring.rest_length),
                                    static_cast<double>(spring.stiffness)};
        energy += spring_energy(position(spring.j) - position(spring.i), law);
    }
    for (std::uint32_t t = parts.tets.first; t < parts.tets.end(); ++t) {
        const NeoHookeanTet& tet = model.neo_hookean_tets[t];
        const Mat3<double> f = gradient_of<double>(
            tet, {position(tet.node_0), position(tet.node_1), position(tet.node_2), position(tet.node_3)});
        energy += neo_hookean_energy(f, tet_moduli<double>(tet));
    }
    return energy;
}

template <class Real>
double flat_tet_energy(const Model& model, const Range& tets, std::span<const Vec4<Real>> positions) {
    double energy = 0.0;
    for (std::uint32_t t = tets.first; t < tets.end(); ++t) {
        const glm::uvec4& corners = model.tets[t];
        const TetRest& rest = model.tet_rests[t];
        const glm::dvec3 first(positions[corners.x]);
        const glm::dvec3 slope =
            volume_slope(glm::dvec3(positions[corners.y]) - first, glm::dvec3(positions[corners.z]) - first,
                         inverse_six_volumes<double>(rest));
        const double ratio = glm::dot(slope, glm::dvec3(positions[corners.w]) - first);
        energy +=
            flat_tet_energy(ratio, static_cast<double>(rest.volume) * static_cast<double>(rest.modulus));
    }
    return energy;
}

// In tasks that threads share: the sum is the same for any number of them.
template <class Real>
double body_energy(const Model& model, const ModelObject& object, std::span<const Vec4<Real>> positions) {
    const Range flat_tets = object.neo_hookean_tets.count == 0 ? object.tets : Range();
    const std::uint32_t elements =
        object.nodes.count + object.springs.count + object.neo_hookean_tets.count + flat_tets.count;
    std::vector<double> energies(elements / kElementsATask + 1);
    const auto tasks = static_cast<std::uint32_t>(energies.size());
    for_each_index(0, tasks, 1, [&](std::size_t k) {
        const auto share = [&](const Range& all) {
            return share_of(all, static_cast<std::uint32_t>(k), tasks);
        };
        energies[k] = elastic_energy<Real>(
                          model, {share(object.nodes), share(object.springs), share(object.neo_hookean_tets)},
                          positions) +
                      flat_tet_energy<Real>(model, share(flat_tets), positions);
    });
    return std::accumulate(energies.begin(), energies.end(), 0.0);
}

template double elastic_energy<float>(const Model&, const ElasticParts&, std::span<const Vec4<float>>);
template double elastic_energy<double>(const Model&, const ElasticParts&, std::span<const Vec4<double>>);
template double flat_tet_energy<float>(const Model&, const Range&, std::span<const Vec4<float>>);
template double flat_tet_energy<double>(const Model&, const Range&, std::span<const Vec4<double>>);
template double body_energy<float>(const Model&, const ModelObject&, std::span<const Vec4<float>>);
template double body_energy<double>(const Model&, const ModelObject&, std::span<const Vec4<double>>);

}  // namespace gelatin::cpu
