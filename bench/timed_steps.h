#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/stages.h"
#include "model/solver.h"

namespace gelatin {

/// What a step is: its solver, its size [s], and for the implicit one its iterations.
struct StepSettings {
    SolverKind solver;
    double step;
    ImplicitSettings descent = {};
};

std::unique_ptr<Solver> make_bench_solver(const std::shared_ptr<const Model>& model,
                                          const StageSystem& system, const StepSettings& settings);

/// Steps of one model on one system, without a response to collisions, timed as a whole by the host's clock.
class TimedSteps {
public:
    /// Makes two steps from `start`, which compile shaders and fault pages in, and returns to it.
    TimedSteps(const std::shared_ptr<const Model>& model, const State& start, const StageSystem& system,
               const StepSettings& settings);

    /// The mean time of a few steps, as many as take about 5 ms [ms].
    double sample();

private:
    double run(int steps);

    StageSystem system_;
    StepSettings settings_;
    std::unique_ptr<Solver> solver_;
    int steps_ = 1;  // of a sample
};

/// Samples each in turn, so that a machine that slows down affects all of them: [ms], shape [cases][runs].
std::vector<std::vector<double>> sample_in_turn(std::vector<TimedSteps>& cases, int runs);

}  // namespace gelatin
