#include "cpu/elasticity/elastic_energy.h"

#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "cpu/elasticity/neo_hookean.h"
#include "cpu/elasticity/spring_energies.h"
#include "cpu/elasticity/volume_ratios.h"
#include "cpu/elasticity/volume_term.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kElementsATask = 4096;

// The sum of of_task(share_of), with share_of(range) a task's share of any range.
// @param elements that share tasks
template <class OfTask>
double sum_tasks(std::uint32_t elements, const OfTask& of_task) {
    std::vector<double> sums(elements / kElementsATask + 1);
    for_each_index(0, sums.size(), 1, [&](std::size_t task) {
        sums[task] = of_task([&](const Range& all) {
            const auto start = [&](std::size_t k) {
                return static_cast<std::uint32_t>(k * all.count / sums.size());
            };
            return Range{all.first + start(task), start(task + 1) - start(task)};
        });
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

// The energy of the volume term around one node [J].
template <class Position>
double volume_energy(const VolumeTerm& term, std::uint32_t n, const Position& position) {
    const glm::dvec2 node(term.nodes[n]);
    return node.x * node.y * volume_potential(volume_ratio_round<double>(term, n, position), node.y);
}

// The same. @param volume of all tets around it [m^3]
double volume_energy(const VolumeTerm& term, std::uint32_t n, double volume) {
    const glm::dvec2 node(term.nodes[n]);
    return node.x > 0.0 ? node.x * node.y * volume_potential(0.25 * volume / node.x, node.y) : 0.0;
}

// By node of a body, of all tets around it [m^3]. They are added by one thread: that takes less time than to
// gather them by node. @param volumes of its tets [m^3]
template <class Real>
std::vector<double> volumes_around_nodes(const Model& model, const ModelObject& object,
                                         std::span<const Real> volumes) {
    std::vector<double> around(object.nodes.count);
    for (std::uint32_t t = 0; t < object.tets.count; ++t)
        for (int k = 0; k < 4; ++k)
            around[model.tets[object.tets.first + t][k] - object.nodes.first] +=
                static_cast<double>(volumes[t]);
    return around;
}

// Volume ratios of tets. @return what flat ones hold, if they are of springs [J]
template <class Real>
double find_ratios(const Model& model, const Range& tets, std::span<const Vec4<Real>> positions, Real* ratios,
                   bool are_springs) {
    const auto flattest = static_cast<Real>(kFlattest);
    constexpr Real kAny = std::numeric_limits<Real>::infinity();
    const bool any_flat = !volumes_are_within(flattest, kAny, model, tets, positions.data(), ratios);
    double energy = 0.0;
    for (std::uint32_t t = tets.first; any_flat && are_springs && t < tets.end(); ++t) {
        const TetRest& rest = model.tet_rests[t];
        energy += flat_tet_energy(static_cast<double>(ratios[t - tets.first]),
                                  static_cast<double>(rest.volume) * static_cast<double>(rest.modulus));
    }
    return energy;
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

// In tasks that threads share: the sum is the same for any number of them. Tets come first: nodes need their
// volumes.
template <class Real>
double body_energy(const Model& model, const ModelObject& object, std::span<const Vec4<Real>> positions) {
    const bool has_flat_tets = object.neo_hookean_tets.count == 0;
    const bool has_volumes = !model.volume_term.is_empty();
    std::vector<Real> volumes(has_flat_tets || has_volumes ? object.tets.count : 0);
    double energy = 0.0;
    if (!volumes.empty())
        energy += sum_tasks(object.tets.count, [&](const auto& share_of) {
            const Range tets = share_of(object.tets);
            Real* const of_task = volumes.data() + (tets.first - object.tets.first);
            const double flat = find_ratios(model, tets, positions, of_task, has_flat_tets);
            for (std::uint32_t t = 0; has_volumes && t < tets.count; ++t)
                of_task[t] *= static_cast<Real>(model.tet_rests[tets.first + t].volume);
            return flat;
        });
    std::vector<double> around;
    if (has_volumes) around = volumes_around_nodes<Real>(model, object, volumes);
    const std::uint32_t elements = object.nodes.count + object.springs.count + object.neo_hookean_tets.count;
    return energy + sum_tasks(elements, [&](const auto& share_of) {
               const Range springs = share_of(object.springs);
               double sum = sum_spring_energies(
                   std::span(model.springs).subspan(springs.first, springs.count), positions.data());
               sum += elastic_energy<Real>(model, {{}, {}, share_of(object.neo_hookean_tets)}, positions);
               if (has_volumes) {
                   const Range nodes = share_of(object.nodes);
                   for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
                       sum += volume_energy(model.volume_term, n, around[n - object.nodes.first]);
               }
               return sum;
           });
}

template double elastic_energy<float>(const Model&, const ElasticParts&, std::span<const Vec4<float>>);
template double elastic_energy<double>(const Model&, const ElasticParts&, std::span<const Vec4<double>>);
template double flat_tet_energy<float>(const Model&, const Range&, std::span<const Vec4<float>>);
template double flat_tet_energy<double>(const Model&, const Range&, std::span<const Vec4<double>>);
template double body_energy<float>(const Model&, const ModelObject&, std::span<const Vec4<float>>);
template double body_energy<double>(const Model&, const ModelObject&, std::span<const Vec4<double>>);

}  // namespace gelatin::cpu
