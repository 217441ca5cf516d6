#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "bench/stages.h"
#include "bench/timed_steps.h"
#include "cpu/descent/implicit_solver.h"
#include "model/solver.h"

namespace gelatin {

/// Steps of implicit Euler in double precision, by so many sweeps of vertex block descent that more change
/// nothing that matters.
class ConvergedSteps {
public:
    ConvergedSteps(std::shared_ptr<const Model> model, double step, int sweeps);

    /// Where the nodes are a step after `start` [m], shape [nodes].
    std::vector<glm::dvec3> end(const State& start);

private:
    double step_;
    cpu::ImplicitSolver<double> solver_;
};

/// A step of a run, and where it should end.
struct SampledStep {
    State start;
    std::vector<glm::dvec3> end;  ///< converged [m], shape [nodes]
};

/// The steps of a run on the CPU that follow these numbers of steps.
/// @param settings of vertex block descent @param moments ascending
std::vector<SampledStep> sample_steps(const std::shared_ptr<const Model>& model, const StepSettings& settings,
                                      const std::vector<int>& moments, ConvergedSteps& reference);

/// The largest distance of a node from where the step should end, over the largest displacement of a node in
/// the step.
double step_error(const SampledStep& sampled, const std::vector<glm::dvec3>& positions);

/// Where nodes that feel no elastic force are a step after `start` [m], shape [nodes].
std::vector<glm::dvec3> free_motion(const Model& model, const State& start, double step);

/// The mean error of these steps, as that system makes them.
double mean_step_error(const std::shared_ptr<const Model>& model, const StepSettings& settings,
                       const StageSystem& system, const std::vector<SampledStep>& steps);

}  // namespace gelatin
