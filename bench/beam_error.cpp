#include "bench/beam_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/make_solver.h"
#include "model/explicit/stability.h"

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

int parts_of_step(const Model& model, double step) {
    constexpr int kLeast = 10;
    return std::max(kLeast,
                    static_cast<int>(std::ceil(step / (0.8 * largest_stable_step(SolverKind::rk4, model)))));
}

ExactMotion::ExactMotion(std::shared_ptr<const Model> model, double step, int parts)
    : step_(step), parts_(parts), solver_(std::move(model), SolverKind::rk4, ForceMethod::fused) {}

std::vector<glm::dvec3> ExactMotion::end(const State& start) {
    solver_.write_state(start);
    for (int p = 0; p < parts_; ++p) solver_.advance({step_ / parts_});
    return points(solver_.nodes().positions);
}

std::vector<SampledStep> sample_steps(const std::shared_ptr<const Model>& model, const StepSettings& settings,
                                      const std::vector<int>& moments, ExactMotion& exact) {
    const auto solver =
        cpu::make_solver<float>(model, settings.solver, ForceMethod::fused, {}, settings.descent);
    std::vector<SampledStep> steps;
    int made = 0;
    for (const int moment : moments) {
        for (; made < moment; ++made) solver->advance({settings.step});
        const State start = solver->read_state();
        steps.push_back({start, exact.end(start)});
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
