#include "gpu/support/pull_on_gpu.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/cpu_solver.h"
#include "gpu/gpu_solver.h"
#include "support/parity.h"

namespace gelatin::test {
namespace {

constexpr double kEps = std::numeric_limits<float>::epsilon();
constexpr DescentSettings kSweeps{4};

double largest(const std::vector<glm::vec4>& values) {
    double most = 0.0;
    for (const glm::vec4& v : values) most = std::max(most, glm::length(glm::dvec3(v)));
    return most;
}

StepBounds bounds_for(const Model& model, const Pull& pull, SolverKind solver, double step) {
    const bool descends = solver == SolverKind::vbd;
    const SolverKind alike = descends ? SolverKind::semi_implicit_euler : solver;
    StepBounds bounds = rounding_bounds(model, alike, step);
    const double x = largest(model.positions) + glm::length(pull.target), v = largest(model.velocities);
    const double time = step + pull.damping_time;
    const int passes = explicit_scheme(alike).pass_count;
    for (const Pull::Node& held : pull.nodes) {
        const double strength =
            static_cast<double>(held.stiffness) * static_cast<double>(model.positions[held.node].w);
        const double acceleration = passes * 16.0 * kEps * strength / (1.0 + strength * step * time) *
                                    (x + static_cast<double>(glm::length(held.arm)) + time * v);
        bounds.velocity[held.node] += step * acceleration;
        bounds.position[held.node] += step * step * acceleration;
    }
    if (!descends) return bounds;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        bounds.position[n] *= kSweeps.iterations;
        bounds.velocity[n] += bounds.position[n] / step;
    }
    return bounds;
}

}  // namespace

Pull make_pull(const Model& model) {
    Pull pull;
    pull.target = {0.4, 1.5, -0.3};
    pull.damping_time = 0.03;
    const Range& nodes = model.objects[0].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); n += 2) {
        const glm::vec3 arm(0.01f * static_cast<float>(n % 7), 0.02f, -0.01f * static_cast<float>(n % 5));
        pull.nodes.push_back({n, arm, model.masses[n] * static_cast<float>(500 + n % 11)});
    }
    return pull;
}

double worst_pull_error(const Model& model, SolverKind solver, ForceMethod forces, double step) {
    const auto shared = std::make_shared<const Model>(model);
    cpu::CpuSolver<double> reference(shared, solver, forces, {}, kSweeps);
    gpu::GpuSolver actual(shared, solver, forces, {}, kSweeps);
    const Pull pull = make_pull(model);
    for (Solver* each : {static_cast<Solver*>(&reference), static_cast<Solver*>(&actual)}) {
        each->set_pull(pull);
        each->advance_nodes(step);
    }
    const State state = actual.read_state();
    return worst_error(model, bounds_for(model, pull, solver, step), reference.nodes(), state.positions,
                       state.velocities);
}

}  // namespace gelatin::test
