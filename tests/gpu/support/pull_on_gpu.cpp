#include "gpu/support/pull_on_gpu.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "cpu/make_solver.h"
#include "gpu/make_solver.h"
#include "support/parity.h"

namespace gelatin::test {
namespace {

constexpr double kPullEps = std::numeric_limits<float>::epsilon();

double largest(const std::vector<glm::vec4>& values) {
    double most = 0.0;
    for (const glm::vec4& v : values) most = std::max(most, glm::length(glm::dvec3(v)));
    return most;
}

StepBounds bounds_for(const Model& model, const std::vector<Pull>& pulls, SolverKind solver, double step) {
    StepBounds bounds = rounding_bounds(model, solver, step);
    const double v = largest(model.velocities);
    const int passes = explicit_scheme(solver).pass_count;
    const auto add = [&](std::uint32_t node, double rounded) {  // [m/s^2]
        const double acceleration = passes * 16.0 * kPullEps * rounded;
        bounds.velocity[node] += step * acceleration;
        bounds.position[node] += step * step * acceleration;
    };
    for (const Pull& pull : pulls) {
        const double x = largest(model.positions) + glm::length(pull.target), time = step + pull.damping_time;
        for (const Pull::Node& held : pull.nodes) {
            const double strength =
                static_cast<double>(held.stiffness) * static_cast<double>(model.positions[held.node].w);
            add(held.node, strength / (1.0 + strength * step * time) *
                               (x + static_cast<double>(glm::length(held.arm)) + time * v));
        }
    }
    const std::vector<glm::vec3> forces = make_forces(model);
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        add(n, static_cast<double>(glm::length(forces[n]) * model.positions[n].w));
    return bounds;
}

}  // namespace

std::vector<Pull> make_pulls(const Model& model) {
    std::vector<Pull> pulls(2);
    Pull& pull = pulls[0];
    pull.target = {0.4, 1.5, -0.3};
    pull.damping_time = 0.03;
    const Range& nodes = model.objects[0].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); n += 2) {
        const glm::vec3 arm(0.01f * static_cast<float>(n % 7), 0.02f, -0.01f * static_cast<float>(n % 5));
        pull.nodes.push_back({n, arm, model.masses[n] * static_cast<float>(500 + n % 11)});
    }
    pulls[1].target = {-0.5, 0.2, 0.7};
    pulls[1].damping_time = 0.01;
    for (std::uint32_t n = nodes.first; n < nodes.end(); n += 3)
        pulls[1].nodes.push_back({n, glm::vec3(0.02f), model.masses[n] * 300.0f});
    return pulls;
}

std::vector<glm::vec3> make_forces(const Model& model) {
    std::vector<glm::vec3> forces(model.node_count(), glm::vec3(0.0f));
    for (std::uint32_t n = 0; n < model.node_count(); n += 5)
        forces[n] = model.masses[n] * glm::vec3(100.0f, -200.0f + static_cast<float>(n % 7), 50.0f);
    return forces;
}

double worst_pull_error(const Model& model, SolverKind solver, ForceMethod forces, double step) {
    const auto shared = std::make_shared<const Model>(model);
    const auto reference = cpu::make_solver<double>(shared, solver, forces);
    const auto actual = gpu::make_solver(shared, solver, forces);
    const std::vector<Pull> pulls = make_pulls(model);
    Pull away = pulls[0];
    for (Pull::Node& held : away.nodes) held.node += model.node_count() - 1 - away.nodes.back().node;
    for (Solver* each : {static_cast<Solver*>(reference.get()), static_cast<Solver*>(actual.get())}) {
        each->set_pulls({away});
        each->set_pulls({pulls[1], pulls[0]});
        each->move_pull(0, {9.0, 9.0, 9.0});
        each->move_pull(0, pulls[1].target);
        each->set_forces(make_forces(model));
        each->advance({step});
    }
    const State state = actual->read_state();
    return worst_error(model, bounds_for(model, pulls, solver, step), reference->nodes(), state.positions,
                       state.velocities);
}

}  // namespace gelatin::test
