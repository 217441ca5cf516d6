#include "model/assembly/model_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace gelatin {
namespace {

constexpr double kEpsilon = 0x1p-24;     // relative rounding of a float
constexpr double kMuch = 1e6;            // sums of such different terms keep a digit of the smaller one
constexpr double kLargestStrain = 1e-2;  // from rounding alone

double shortest_spring(const Model& model, const ModelObject& object) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::uint32_t s = object.springs.first; s < object.springs.end(); ++s)
        shortest = std::min(shortest, static_cast<double>(model.springs[s].rest_length));
    return shortest;
}

std::optional<std::string> far_from_origin(const Model& model, const ModelObject& object) {
    double farthest = 0.0;
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        const glm::dvec3 p = glm::abs(glm::dvec3(model.positions[n]));
        farthest = std::max({farthest, p.x, p.y, p.z});
    }
    const double shortest = shortest_spring(model, object), strain = kEpsilon * farthest / shortest;
    if (!(strain > kLargestStrain)) return {};
    return fmt::format(
        "object '{}': at coordinates of {:.3g} m single precision rounds its shortest spring, of {:.3g} m, "
        "by {:.1g} of its length; at coordinates below {:.3g} m the error is below {}",
        object.name, farthest, shortest, strain, kLargestStrain * shortest / kEpsilon, kLargestStrain);
}

std::optional<std::string> uneven_materials(const Model& model, const ModelObject& object) {
    double softest = std::numeric_limits<double>::infinity(), stiffest = 0.0;
    for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t) {
        const auto modulus = static_cast<double>(model.tet_rests[t].modulus);
        softest = std::min(softest, modulus);
        stiffest = std::max(stiffest, modulus);
    }
    if (!(stiffest > kMuch * softest)) return {};
    return fmt::format(
        "object '{}': its parts have youngs_modulus from {:.3g} to {:.3g} Pa; where they meet, single "
        "precision loses the forces of a part that is more than {:.0g} times softer",
        object.name, softest, stiffest, kMuch);
}

std::optional<std::string> lost_inertia(const Model& model, const ModelObject& object, double step_size) {
    std::vector<double> stiffness(object.nodes.count, 0.0);
    for (std::uint32_t s = object.springs.first; s < object.springs.end(); ++s) {
        for (const std::uint32_t end : {model.springs[s].i, model.springs[s].j})
            stiffness[end - object.nodes.first] += static_cast<double>(model.springs[s].stiffness);
    }
    double worst = 0.0;
    for (std::uint32_t n = 0; n < object.nodes.count; ++n) {
        const auto mass = static_cast<double>(model.masses[object.nodes.first + n]);
        worst = std::max(worst, stiffness[n] * step_size * step_size / mass);
    }
    if (!(worst > 1.0 / kEpsilon)) return {};
    return fmt::format(
        "object '{}': a node's springs are {:.2g} times as stiff as its inertia over a step (stiffness h^2 / "
        "mass); above {:.2g} single precision loses the inertia: shorter steps (simulation.substeps) or a "
        "smaller "
        "youngs_modulus help",
        object.name, worst, 1.0 / kEpsilon);
}

std::optional<std::string> uneven_masses(const Model& model) {
    if (model.body_count() < 2) return {};
    const auto [light, heavy] =
        std::minmax_element(model.bodies().begin(), model.bodies().end(),
                            [](const ModelObject& a, const ModelObject& b) { return a.mass < b.mass; });
    if (!(heavy->mass > kMuch * light->mass)) return {};
    return fmt::format(
        "object '{}' has {:.2g} times the mass of '{}' ({:.3g} and {:.3g} kg); where they touch, single "
        "precision keeps less than a digit of the lighter one's effect on the heavier above {:.0g}",
        heavy->name, heavy->mass / light->mass, light->name, heavy->mass, light->mass, kMuch);
}

// Mesh files name no unit, and those of CAD are usually in millimetres.
std::optional<std::string> seems_to_be_in_millimetres(const Model& model, const ModelObject& object,
                                                      const Scene& scene) {
    constexpr double kLarge = 20.0, kMillimetre = 1e-3;  // [m]
    constexpr double kEarth = 9.81, kAbout = 0.05;       // [m/s^2]
    if (std::abs(glm::length(scene.gravity()) - kEarth) > kAbout) return {};
    const Range nodes = object.shape_nodes();
    glm::dvec3 low(model.positions[nodes.first]), high = low;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        low = glm::min(low, glm::dvec3(model.positions[n]));
        high = glm::max(high, glm::dvec3(model.positions[n]));
    }
    const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (size < kLarge) return {};
    const auto described = std::find_if(scene.objects.begin(), scene.objects.end(),
                                        [&](const auto& each) { return each.name == object.name; });
    const double scale = described != scene.objects.end() ? described->scale : 1.0;
    return fmt::format(
        "object '{}': it is {:.3g} m large, and gravity is in metres; if its shape is in millimetres, scale "
        "= "
        "{:.3g} makes it {:.3g} m large",
        object.name, size, kMillimetre * scale, kMillimetre * size);
}

// The first object's line; the lines of its copies would be the same.
template <class Check>
void add_first(const Model& model, const Check& check, std::vector<std::string>& lines) {
    std::optional<std::string> first;
    std::size_t others = 0;
    for (const ModelObject& object : model.bodies()) {
        const std::optional<std::string> line = check(object);
        if (line && first) ++others;
        if (!first) first = line;
    }
    if (first) lines.push_back(*first + (others > 0 ? fmt::format(" (and {} more objects)", others) : ""));
}

}  // namespace

std::vector<std::string> check_model(const Model& model, const Scene& scene, double step_size) {
    std::vector<std::string> lines;
    add_first(
        model, [&](const ModelObject& o) { return seems_to_be_in_millimetres(model, o, scene); }, lines);
    add_first(
        model, [&](const ModelObject& o) { return far_from_origin(model, o); }, lines);
    add_first(
        model, [&](const ModelObject& o) { return uneven_materials(model, o); }, lines);
    if (is_implicit(scene.simulation.solver)) {
        add_first(
            model, [&](const ModelObject& o) { return lost_inertia(model, o, step_size); }, lines);
    }
    if (const std::optional<std::string> line = uneven_masses(model)) lines.push_back(*line);
    return lines;
}

}  // namespace gelatin
