#include "support/parity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/elasticity/neo_hookean.h"
#include "cpu/explicit/explicit_solver.h"
#include "model/elasticity/neo_hookean.h"
#include "support/instruction_sets.h"

namespace gelatin::test {
namespace {

double largest(const std::vector<glm::vec4>& values) {
    double most = 0.0;
    for (const glm::vec4& v : values) most = std::max(most, static_cast<double>(glm::length(glm::vec3(v))));
    return most;
}

// Adds the bounds of tets to those of the nodes' forces.
void add_tet_bounds(const Model& model, double x, double v, std::vector<double>& force,
                    std::vector<int>& valence) {
    for (const NeoHookeanTet& tet : model.neo_hookean_tets) {
        const auto gradients = shape_gradients(tet);
        double lengths = 0.0;
        for (const glm::dvec3& g : gradients) lengths += glm::length(g);
        const cpu::Mat3<double> f(cpu::gradient_of(tet, cpu::at_corners<float>(tet, model.positions.data())));
        const double size = std::sqrt(cpu::double_dot(f, f)), ratio = std::abs(glm::determinant(f));
        const double mu = static_cast<double>(tet.gradient_2.w),
                     lambda = static_cast<double>(tet.gradient_3.w);
        const double damping = static_cast<double>(cpu::mean_damping_time(tet, model.velocities.data()));
        const double stress = (3.0 + 2.0 * size) * mu +
                              lambda * (std::pow(size, 4) + 2.0 * (ratio + 1.0) * size) +
                              damping * (3.0 * mu + 2.0 * lambda) * size * (lengths * v + size * v / x);
        for (int k = 0; k < 4; ++k) {
            force[nodes_of(tet)[k]] += static_cast<double>(tet.gradient_1.w) *
                                       glm::length(gradients[static_cast<std::size_t>(k)]) * stress *
                                       lengths * x;
            ++valence[nodes_of(tet)[k]];
        }
    }
}

// Adds the bounds of the volume term to those of the nodes' forces: a tet's volume changes by its slopes
// times X where its corners move by X, and a slope by a third of the length of the face's edges.
void add_volume_bounds(const Model& model, double x, std::vector<double>& force, std::vector<int>& valence) {
    const VolumeTerm& term = model.volume_term;
    if (term.is_empty()) return;
    std::vector<glm::dvec4> slopes, lengths;          // of each tet by its corners [m^2], [m]
    std::vector<double> changes(model.node_count());  // of the volume round each node [m^3]
    for (const glm::uvec4& tet : model.tets) {
        slopes.emplace_back();
        lengths.emplace_back();
        for (int k = 0; k < 4; ++k) {
            const auto corner = [&](int o) {
                return glm::dvec3(model.positions[tet[kOppositeCorners[k][o]]]);
            };
            const glm::dvec3 u = corner(1) - corner(0), v = corner(2) - corner(0);
            slopes.back()[k] = glm::length(glm::cross(u, v)) / 6.0;
            lengths.back()[k] = (glm::length(u) + glm::length(v)) / 3.0;
        }
        const glm::dvec4& own = slopes.back();
        for (int k = 0; k < 4; ++k) changes[tet[k]] += 0.25 * (own.x + own.y + own.z + own.w) * x;
    }
    for (std::size_t t = 0; t < model.tets.size(); ++t) {
        const glm::uvec4& tet = model.tets[t];
        double stress = 0.0,
               change = 0.0;  // [Pa]; a stress is less than kappa where the volume less than doubles
        for (int k = 0; k < 4; ++k) {
            const glm::dvec2 node(term.nodes[tet[k]]);
            stress += 0.25 * std::abs(node.y);
            change += 0.25 * std::abs(node.y) * changes[tet[k]] / node.x;
        }
        for (int k = 0; k < 4; ++k) {
            force[tet[k]] += change * slopes[t][k] + stress * lengths[t][k] * x;
            ++valence[tet[k]];
        }
    }
}

}  // namespace

bool guard_is_untouched(const std::vector<glm::vec4>& values, std::size_t count) {
    return values.size() == count + kGuard && std::all_of(values.begin() + static_cast<std::ptrdiff_t>(count),
                                                          values.end(), [](const glm::vec4& v) {
                                                              return std::isnan(v.x) && std::isnan(v.y) &&
                                                                     std::isnan(v.z) && std::isnan(v.w);
                                                          });
}

cpu::Nodes<double> oracle_step(const Model& model, SolverKind solver, double step) {
    cpu::ExplicitSolver<double> oracle(std::make_shared<const Model>(model), solver, ForceMethod::fused);
    oracle.advance({step});
    return oracle.nodes();
}

StepBounds rounding_bounds(const Model& model, SolverKind solver, double step) {
    constexpr double kEps = std::numeric_limits<float>::epsilon();
    const double x = largest(model.positions), v = largest(model.velocities);
    std::vector<double> force(model.node_count(), 0.0);
    std::vector<int> valence(model.node_count(), 0);
    for (const Spring& s : model.springs) {
        const double length = static_cast<double>(
            glm::distance(glm::vec3(model.positions[s.i]), glm::vec3(model.positions[s.j])));
        const double damping = std::max(static_cast<double>(model.velocities[s.i].w),
                                        static_cast<double>(model.velocities[s.j].w));
        const double part = static_cast<double>(s.stiffness) * (x + damping * v * (1.0 + x / length));
        for (const std::uint32_t n : {s.i, s.j}) {
            force[n] += part;
            ++valence[n];
        }
    }
    for (const LoadedNode& loaded : model.loads.nodes) {
        for (std::uint32_t e = loaded.first; e < loaded.end; ++e) {
            const glm::dvec4 load(model.loads.entries[e].force);
            force[loaded.node] += glm::length(glm::dvec3(load)) + 4.0 * std::abs(load.w) * x * x;
            ++valence[loaded.node];
        }
    }
    add_tet_bounds(model, x, v, force, valence);
    add_volume_bounds(model, x, force, valence);
    const int passes = explicit_scheme(solver).pass_count;
    StepBounds bounds;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const double acceleration =
            8.0 * kEps * (valence[n] + 4) * force[n] * static_cast<double>(model.positions[n].w);
        bounds.velocity.push_back(passes * (step * acceleration + 16.0 * kEps * v));
        bounds.position.push_back(passes * (step * step * acceleration + 16.0 * kEps * (x + step * v)));
    }
    return bounds;
}

double worst_error(const Model& model, const StepBounds& bounds, const cpu::Nodes<double>& expected,
                   const std::vector<glm::vec4>& positions, const std::vector<glm::vec4>& velocities) {
    double worst = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const double p =
            glm::distance(glm::dvec3(positions[n]), glm::dvec3(expected.positions[n])) / bounds.position[n];
        const double v =
            glm::distance(glm::dvec3(velocities[n]), glm::dvec3(expected.velocities[n])) / bounds.velocity[n];
        const bool same_constants =
            positions[n].w == model.positions[n].w && velocities[n].w == model.velocities[n].w;
        if (!std::isfinite(p + v) || !same_constants) return std::numeric_limits<double>::infinity();
        worst = std::max({worst, p, v});
    }
    return worst;
}

double worst_simd_error(const Model& model, SolverKind solver, double step) {
    const cpu::Nodes<double> expected = oracle_step(model, solver, step);
    const StepBounds bounds = rounding_bounds(model, solver, step);
    double worst = 0.0;
    with_each_instruction_set([&] {
        cpu::ExplicitSolver<float> simd(std::make_shared<const Model>(model), solver, ForceMethod::fused);
        simd.advance({step});
        const State state = simd.read_state();
        worst = std::max(worst, worst_error(model, bounds, expected, state.positions, state.velocities));
    });
    return worst;
}

}  // namespace gelatin::test
