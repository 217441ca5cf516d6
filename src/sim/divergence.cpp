#include "sim/divergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/tet_check.h"
#include "model/explicit/explicit_scheme.h"
#include "model/explicit/stability.h"

namespace gelatin {
namespace {

const ModelObject& object_of(const Model& model, std::uint32_t node) {
    return *std::find_if(model.objects.begin(), model.objects.end(),
                         [&](const ModelObject& object) { return node < object.nodes.end(); });
}

std::string flat_tet_at(const Model& model, const ModelObject& object, std::uint32_t node) {
    constexpr double kFlat = 1e-3;
    for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t) {
        const glm::uvec4& tet = model.tets[t];
        if (tet[0] != node && tet[1] != node && tet[2] != node && tet[3] != node) continue;
        const auto corner = [&](int k) { return glm::dvec3(model.positions[tet[k]]); };
        const double round = roundness({corner(0), corner(1), corner(2), corner(3)});
        if (round < kFlat) {
            return fmt::format(
                "a tet at the node is nearly flat (its volume is {:.1g} of that of a regular one)", round);
        }
    }
    return {};
}

// For each node of an object, the square of a frequency: stiffness of its springs divided by its mass
// [1/s^2].
std::vector<double> stiffness_over_mass(const Model& model, const ModelObject& object) {
    std::vector<double> result(object.nodes.count, 0.0);
    for (std::uint32_t s = object.springs.first; s < object.springs.end(); ++s) {
        const Spring& spring = model.springs[s];
        for (const std::uint32_t end : {spring.i, spring.j}) {
            result[end - object.nodes.first] +=
                static_cast<double>(spring.stiffness) / static_cast<double>(model.masses[end]);
        }
    }
    return result;
}

std::string odd_stiffness_at(const Model& model, const ModelObject& object, std::uint32_t node) {
    constexpr double kOdd = 100.0;
    std::vector<double> all = stiffness_over_mass(model, object);
    const double here = all[node - object.nodes.first];
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    if (!(here > kOdd * *middle)) return {};
    return fmt::format(
        "relative to its mass, the node's springs are {:.2g} times as stiff as the object's median",
        here / *middle);
}

std::string step_too_long(const Model& model, const Scene& scene, double step_size) {
    const SimulationSettings& settings = scene.simulation;
    const double stable = largest_stable_step(settings.solver, model, Deformation::any);
    if (!(step_size > stable)) return {};
    return fmt::format(
        "the step of {:.3g} s is stable for the bodies' shapes at rest (up to {:.3g} s), but not for bodies "
        "that are strongly compressed or stretched; simulation.substeps = {:.0f} (steps of {:.3g} s) is "
        "stable "
        "for any shape, and so is solver = \"implicit\"",
        step_size, largest_stable_step(settings.solver, model), std::ceil(settings.frame_time() / stable),
        stable);
}

}  // namespace

std::uint32_t stiffest_node(const Model& model, const ModelObject& object) {
    const std::vector<double> stiffness = stiffness_over_mass(model, object);
    const auto stiffest = std::max_element(stiffness.begin(), stiffness.end());
    return object.nodes.first + static_cast<std::uint32_t>(stiffest - stiffness.begin());
}

std::string likely_cause(const Model& model, const Scene& scene, std::uint32_t node, double step_size) {
    const ModelObject& object = object_of(model, node);
    std::vector<std::string> causes{flat_tet_at(model, object, node), odd_stiffness_at(model, object, node),
                                    step_too_long(model, scene, step_size)};
    std::erase(causes, std::string());
    if (causes.empty())
        return "neither the mesh there nor the step size is unusual; check velocities, gravity, sizes and "
               "motors";
    return fmt::format("{}", fmt::join(causes, "; "));
}

}  // namespace gelatin
