#include "bench/timed_steps.h"

#include <algorithm>
#include <chrono>

#include "bench/threads.h"
#include "cpu/make_solver.h"
#include "gpu/make_solver.h"

namespace gelatin {
namespace {

// Long enough for the caches to hold what an explicit step reads, short enough to take all cases in turn.
constexpr double kSampleTime = 5.0;  // [ms]
constexpr int kMostSteps = 50;

}  // namespace

std::unique_ptr<Solver> make_bench_solver(const std::shared_ptr<const Model>& model,
                                          const StageSystem& system, const StepSettings& settings) {
    if (system.uses_gl)
        return gpu::make_solver(model, settings.solver, ForceMethod::fused, {}, settings.descent);
    return cpu::make_solver<float>(model, settings.solver, ForceMethod::fused, {}, settings.descent);
}

TimedSteps::TimedSteps(const std::shared_ptr<const Model>& model, const State& start,
                       const StageSystem& system, const StepSettings& settings)
    : system_(system), settings_(settings), solver_(make_bench_solver(model, system, settings)) {
    solver_->write_state(start);
    run(1);
    steps_ = std::clamp(static_cast<int>(kSampleTime / std::max(run(1), 1e-3)), 1, kMostSteps);
    solver_->write_state(start);
}

double TimedSteps::sample() {
    return run(steps_);
}

double TimedSteps::run(int steps) {
    const ThreadLimit limit(system_.threads);
    const auto start = std::chrono::steady_clock::now();
    for (int s = 0; s < steps; ++s) solver_->advance({settings_.step});
    if (system_.uses_gl) gl::finish();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    return elapsed.count() / steps;
}

std::vector<std::vector<double>> sample_in_turn(std::vector<TimedSteps>& cases, int runs) {
    std::vector<std::vector<double>> samples(cases.size());
    for (int r = 0; r < runs; ++r) {
        for (std::size_t c = 0; c < cases.size(); ++c) samples[c].push_back(cases[c].sample());
    }
    return samples;
}

}  // namespace gelatin
