#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "bench/stages.h"
#include "bench/timed_steps.h"
#include "cpu/explicit/explicit_solver.h"
#include "model/solver.h"

namespace gelatin {

/// How many parts of a step are stable by rk4, with room for springs that stiffen; at least ten.
int parts_of_step(const Model& model, double step);

/// The motion of a model, by so many explicit steps in double precision that more change nothing that
/// matters.
class ExactMotion {
public:
    /// @param parts of a step, by rk4; at least parts_of_step
    ExactMotion(std::shared_ptr<const Model> model, double step, int parts);

    int parts() const { return parts_; }
    /// Where the nodes are a step after `start` [m], shape [nodes].
    std::vector<glm::dvec3> end(const State& start);

private:
    double step_;
    int parts_;
    cpu::ExplicitSolver<double> solver_;
};

/// A step of a run, and where it should end.
struct SampledStep {
    State start;
    std::vector<glm::dvec3> end;  ///< by the exact motion [m], shape [nodes]
};

/// The steps of a run on the CPU that follow these numbers of steps.
/// @param moments ascending
std::vector<SampledStep> sample_steps(const std::shared_ptr<const Model>& model, const StepSettings& settings,
                                      const std::vector<int>& moments, ExactMotion& exact);

/// The largest distance of a node from where the step should end, over the largest displacement of a node in
/// the step.
double step_error(const SampledStep& sampled, const std::vector<glm::dvec3>& positions);

/// Where nodes that feel no elastic force are a step after `start` [m], shape [nodes].
std::vector<glm::dvec3> free_motion(const Model& model, const State& start, double step);

/// The mean error of these steps, as that system makes them.
double mean_step_error(const std::shared_ptr<const Model>& model, const StepSettings& settings,
                       const StageSystem& system, const std::vector<SampledStep>& steps);

}  // namespace gelatin
