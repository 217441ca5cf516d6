#include "support/parity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/cpu_solver.h"

namespace gelatin::test {
namespace {

double largest(const std::vector<glm::vec4>& values) {
    double most = 0.0;
    for (const glm::vec4& v : values) most = std::max(most, static_cast<double>(glm::length(glm::vec3(v))));
    return most;
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
    cpu::CpuSolver<double> oracle(std::make_shared<const Model>(model), solver, ForceMethod::fused);
    oracle.advance_nodes(step);
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

}  // namespace gelatin::test
