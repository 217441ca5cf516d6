#include "bench/beam_error.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/make_solver.h"

namespace gelatin {
namespace {

template <class Real>
std::vector<glm::dvec3> points(const std::vector<glm::vec<4, Real>>& positions) {
    return {positions.begin(), positions.end()};
}

double largest_distance(const std::vector<glm::dvec3>& some, const std::vector<glm::dvec3>& others) {
    double largest = 0.0;
    for (std::size_t n = 0; n < some.size(); ++n)
        largest = std::max(largest, glm::distance(some[n], others[n]));
    return largest;
}

}  // namespace

ConvergedSteps::ConvergedSteps(std::shared_ptr<const Model> model, double step, int sweeps)
    : step_(step), solver_(std::move(model), {}, {sweeps}) {}

std::vector<glm::dvec3> ConvergedSteps::end(const State& start) {
    solver_.write_state(start);
    solver_.advance({step_});
    return points(solver_.nodes().positions);
}

std::vector<SampledStep> sample_steps(const std::shared_ptr<const Model>& model, const StepSettings& settings,
                                      const std::vector<int>& moments, ConvergedSteps& reference) {
    const auto solver =
        cpu::make_solver<float>(model, settings.solver, ForceMethod::fused, {}, settings.descent);
    std::vector<SampledStep> steps;
    int made = 0;
    for (const int moment : moments) {
        for (; made < moment; ++made) solver->advance({settings.step});
        const State start = solver->read_state();
        steps.push_back({start, reference.end(start)});
    }
    return steps;
}

double step_error(const SampledStep& sampled, const std::vector<glm::dvec3>& positions) {
    return largest_distance(positions, sampled.end) /
           largest_distance(points(sampled.start.positions), sampled.end);
}

std::vector<glm::dvec3> free_motion(const Model& model, const State& start, double step) {
    std::vector<glm::dvec3> positions = points(start.positions);
    for (std::size_t n = 0; n < positions.size(); ++n) {
        if (start.positions[n].w == 0.0f) continue;  // held
        positions[n] += step * (glm::dvec3(start.velocities[n]) + step * glm::dvec3(model.gravity));
    }
    return positions;
}

double mean_step_error(const std::shared_ptr<const Model>& model, const StepSettings& settings,
                       const StageSystem& system, const std::vector<SampledStep>& steps) {
    const auto solver = make_bench_solver(model, system, settings);
    double sum = 0.0;
    for (const SampledStep& sampled : steps) {
        solver->write_state(sampled.start);
        solver->advance({settings.step});
        sum += step_error(sampled, points(solver->read_state().positions));
    }
    return sum / static_cast<double>(steps.size());
}

}  // namespace gelatin
