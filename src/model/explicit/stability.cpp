#include "model/explicit/stability.h"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "gelatin/error.h"
#include "model/elasticity/neo_hookean.h"
#include "model/explicit/explicit_scheme.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

constexpr double kLargestGrowth = 0.01;  // of a mode's amplitude, per second
constexpr double kSafety = 0.8;          // of the largest stable step that `auto` uses
constexpr int kMostSubsteps = 100'000;

// Largest modulus of the eigenvalues of one step h applied to (x, v) of x'' = -w^2 x - damping w^2 x'.
double spectral_radius(const ExplicitScheme& scheme, double frequency, double damping, double h) {
    const double w2 = frequency * frequency;
    const auto advance = [&](double x0, double v0) {
        double x = x0, v = v0, sum_x = 0.0, sum_v = 0.0;
        for (int p = 0; p < scheme.pass_count; ++p) {
            const double rate_x = v;
            const double rate_v = -w2 * x - damping * w2 * v;
            sum_x += scheme.passes[static_cast<std::size_t>(p)].weight * rate_x;
            sum_v += scheme.passes[static_cast<std::size_t>(p)].weight * rate_v;
            x = x0 + h * scheme.passes[static_cast<std::size_t>(p)].next * rate_x;
            v = v0 + h * scheme.passes[static_cast<std::size_t>(p)].next * rate_v;
        }
        const double new_v = v0 + h * sum_v;
        return std::pair(x0 + h * (scheme.semi_implicit ? new_v : sum_x), new_v);
    };
    // In the basis (x, v / w) both columns have the same magnitude, which keeps trace and determinant
    // accurate.
    const auto [a, c] = advance(1.0, 0.0);
    const auto [b, d] = advance(0.0, frequency);
    const double half_trace = 0.5 * (a + d / frequency);
    const double determinant = (a * d - b * c) / frequency;
    const double discriminant = half_trace * half_trace - determinant;
    return discriminant < 0.0 ? std::sqrt(determinant) : std::abs(half_trace) + std::sqrt(discriminant);
}

bool is_stable(const ExplicitScheme& scheme, double frequency, double damping, double h) {
    constexpr int kSamples = 96;
    for (int s = 0; s < kSamples; ++s) {  // from the highest mode down six decades
        const double mode = frequency * std::pow(10.0, -6.0 * s / kSamples);
        const double rounding = 1e-12;
        if (std::log(spectral_radius(scheme, mode, damping, h)) > kLargestGrowth * h + rounding) return false;
    }
    return true;
}

// Stiffness divided by mass [1/s^2], a block for each node of an object.
using Blocks = std::vector<Eigen::Matrix3d>;

void add_springs(const Model& model, const ModelObject& object, Deformation deformation,
                 const std::vector<double>& inverse_masses, Blocks& blocks) {
    const auto inverse_mass = [&](std::uint32_t n) { return inverse_masses[n - object.nodes.first]; };
    const auto add = [&](std::uint32_t node, std::uint32_t other, const Eigen::Matrix3d& kn) {
        if (inverse_mass(node) == 0.0) return;
        blocks[node - object.nodes.first] += kn * (inverse_mass(node) + inverse_mass(other));
    };
    for (std::uint32_t s = object.springs.first; s < object.springs.end(); ++s) {
        const Spring& spring = model.springs[s];
        const glm::dvec3 d = glm::dvec3(model.positions[spring.j]) - glm::dvec3(model.positions[spring.i]);
        const Eigen::Vector3d n = Eigen::Vector3d(d.x, d.y, d.z).normalized();
        const auto k = static_cast<double>(spring.stiffness);
        Eigen::Matrix3d kn = k * n * n.transpose();
        if (deformation == Deformation::any) kn = k * Eigen::Matrix3d::Identity();
        add(spring.i, spring.j, kn);
        add(spring.j, spring.i, kn);
    }
}

void add_neo_hookean_tets(const Model& model, const ModelObject& object,
                          const std::vector<double>& inverse_masses, Blocks& blocks) {
    const auto inverse_mass = [&](std::uint32_t n) { return inverse_masses[n - object.nodes.first]; };
    for (std::uint32_t t = object.neo_hookean_tets.first; t < object.neo_hookean_tets.end(); ++t) {
        const NeoHookeanTet& tet = model.neo_hookean_tets[t];
        const glm::uvec4 nodes = nodes_of(tet);
        const std::array<glm::dvec3, 4> gradients = shape_gradients(tet);
        double scale = 0.0;  // V sum |g|^2 / m
        for (int k = 0; k < 4; ++k) {
            const glm::dvec3& g = gradients[static_cast<std::size_t>(k)];
            scale += static_cast<double>(tet.gradient_1.w) * glm::dot(g, g) * inverse_mass(nodes[k]);
        }
        const double mu = static_cast<double>(tet.gradient_2.w),
                     lambda = static_cast<double>(tet.gradient_3.w);
        const double shear = 0.75 * mu, dilation = lambda - 0.625 * mu;  // Lamé's
        for (int k = 0; k < 4; ++k) {
            if (inverse_mass(nodes[k]) == 0.0) continue;
            const glm::dvec3 n = glm::normalize(gradients[static_cast<std::size_t>(k)]);
            const Eigen::Vector3d normal(n.x, n.y, n.z);
            Eigen::Matrix3d& block = blocks[nodes[k] - object.nodes.first];
            block += scale * (shear + dilation) * normal * normal.transpose();
            block.diagonal().array() += scale * shear;
        }
    }
}

// The derivative of the volume around a node by the positions of the nodes around it, itself included [m^2].
std::vector<std::pair<std::uint32_t, glm::dvec3>> slopes_of_volume(const Model& model, std::uint32_t node) {
    std::vector<std::pair<std::uint32_t, glm::dvec3>> slopes;
    const auto add = [&](std::uint32_t n, const glm::dvec3& slope) {
        const auto found =
            std::find_if(slopes.begin(), slopes.end(), [&](const auto& s) { return s.first == n; });
        if (found == slopes.end()) {
            slopes.emplace_back(n, slope);
        } else {
            found->second += slope;
        }
    };
    const auto position = [&](std::uint32_t n) { return glm::dvec3(model.positions[n]); };
    model.volume_term.corners.for_row(node, [&](const TetCorner& tet) {
        const glm::dvec3 a = position(tet.a), to_b = position(tet.b) - a, to_c = position(tet.c) - a,
                         to_node = position(node) - a;
        const glm::dvec3 by_node = glm::cross(to_b, to_c) / 24.0, by_b = glm::cross(to_c, to_node) / 24.0,
                         by_c = glm::cross(to_node, to_b) / 24.0;
        if (by_node == glm::dvec3(0.0)) return;  // pads the row
        add(node, by_node);
        add(tet.b, by_b);
        add(tet.c, by_c);
        add(tet.a, -(by_node + by_b + by_c));
    });
    return slopes;
}

void add_volume_term(const Model& model, const ModelObject& object, Deformation deformation,
                     const std::vector<double>& inverse_masses, Blocks& blocks) {
    if (model.volume_term.is_empty()) return;
    const auto inverse_mass = [&](std::uint32_t n) { return inverse_masses[n - object.nodes.first]; };
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        const glm::dvec2 rest(model.volume_term.nodes[n]);
        if (!(rest.y > 0.0)) continue;  // it reduces the stiffness
        const auto slopes = slopes_of_volume(model, n);
        double scale = 0.0;  // kappa / V sum |s|^2 / m
        for (const auto& [k, slope] : slopes)
            scale += rest.y / rest.x * glm::dot(slope, slope) * inverse_mass(k);
        for (const auto& [k, slope] : slopes) {
            const double length = glm::length(slope);
            if (inverse_mass(k) == 0.0 || length == 0.0) continue;
            const Eigen::Vector3d normal(slope.x / length, slope.y / length, slope.z / length);
            Eigen::Matrix3d along = scale * normal * normal.transpose();
            if (deformation == Deformation::any) along = scale * Eigen::Matrix3d::Identity();
            blocks[k - object.nodes.first] += along;
        }
    }
}

// The smallest damped fraction of a mode's stiffness. The volume term is not damped; it is at most what it
// would be with each tet by itself.
double least_damped_share(const Model& model, const ModelObject& object) {
    if (model.volume_term.is_empty()) return 1.0;
    double least = 1.0;
    for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t) {
        const TetRest& rest = model.tet_rests[t];
        const auto damped = static_cast<double>(rest.bulk);
        if (rest.kappa >= 0.0f)
            least = std::min(least, damped / (damped + static_cast<double>(model.volume_term.tets[t])));
    }
    return least;
}

}  // namespace

double frequency_bound(const Model& model, const ModelObject& object, Deformation deformation) {
    // Nodes that a handle will release count as free. Held nodes do not make any frequency higher.
    const std::vector<double> inverse_masses = free_inverse_masses(model, object);
    Blocks blocks(object.nodes.count, Eigen::Matrix3d::Zero());
    add_springs(model, object, deformation, inverse_masses, blocks);
    add_neo_hookean_tets(model, object, inverse_masses, blocks);
    add_volume_term(model, object, deformation, inverse_masses, blocks);
    double largest = 0.0;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    for (const Eigen::Matrix3d& block : blocks) {
        solver.compute(block, Eigen::EigenvaluesOnly);
        largest = std::max(largest, solver.eigenvalues()[2]);
    }
    return std::sqrt(largest);
}

double largest_stable_step(SolverKind solver, double frequency, double damping) {
    if (frequency <= 0.0 || is_implicit(solver)) return std::numeric_limits<double>::infinity();
    const ExplicitScheme& scheme = explicit_scheme(solver);
    double stable = 0.0;
    double unstable = 4.0 / frequency;  // above the limit of all schemes
    for (int i = 0; i < 60; ++i) {
        const double middle = stable > 0.0 ? 0.5 * (stable + unstable) : unstable / 16.0;
        if (is_stable(scheme, frequency, damping, middle)) {
            stable = middle;
        } else {
            unstable = middle;
        }
    }
    return stable;
}

double largest_stable_step(SolverKind solver, const Model& model, Deformation deformation) {
    if (is_implicit(solver)) return std::numeric_limits<double>::infinity();
    // Of bodies with the same damping, the one with the highest frequency determines the step.
    std::map<double, double> frequencies;
    for (const ModelObject& object : model.objects) {
        double damping = 0.0;
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
            damping = std::max(damping, static_cast<double>(model.velocities[n].w));
        const double frequency = frequency_bound(model, object, deformation);
        for (const double share : {1.0, least_damped_share(model, object)}) {
            double& highest = frequencies[share * damping];
            highest = std::max(highest, frequency);
        }
    }
    double step = std::numeric_limits<double>::infinity();
    for (const auto& [damping, frequency] : frequencies)
        step = std::min(step, largest_stable_step(solver, frequency, damping));
    return step;
}

int choose_substeps(const Scene& scene, const Model& model) {
    const SimulationSettings& settings = scene.simulation;
    const double largest = largest_stable_step(settings.solver, model);
    const double needed = std::ceil(settings.frame_time() / (kSafety * largest));
    const std::string advice =
        settings.solver == SolverKind::explicit_euler
            ? "; explicit_euler amplifies motion that is not damped: semi_implicit_euler does not"
            : "";
    if (settings.substeps) {
        const double step = settings.frame_time() / *settings.substeps;
        if (step <= largest) return *settings.substeps;
        throw InvalidInput({scene.file.string(), 0, "simulation.substeps", std::to_string(*settings.substeps),
                            fmt::format("a step of {:.3g} s is too long; the largest safe step is {:.3g} s "
                                        "(substeps = {:.0f}, or \"auto\"){}",
                                        step, largest, needed, advice)});
    }
    if (needed > kMostSubsteps) {
        throw InvalidInput(
            {scene.file.string(), 0, "simulation.substeps", "\"auto\"",
             fmt::format("{} would need steps of {:.3g} s, {:.3g} per frame; at most {} are allowed{}",
                         name_of(settings.solver), kSafety * largest, needed, kMostSubsteps, advice)});
    }
    return std::max(1, static_cast<int>(needed));
}

}  // namespace gelatin
