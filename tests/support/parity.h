#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <string>
#include <vector>

#include "cpu/nodes.h"
#include "model/explicit/explicit_scheme.h"
#include "model/model.h"

namespace gelatin::test {

/// Elements behind the last node that no kernel may touch.
constexpr std::size_t kGuard = 70;

/// NaN everywhere, so that an element that is not written cannot pass; `count` and the guard.
inline std::vector<glm::vec4> poisoned(std::size_t count) {
    return std::vector<glm::vec4>(count + kGuard, glm::vec4(std::numeric_limits<float>::quiet_NaN()));
}

/// True if the elements from `count` on are as `poisoned` made them.
bool guard_is_untouched(const std::vector<glm::vec4>& values, std::size_t count);

/// The double-precision reference: one step of the plain kernels from the model's start.
cpu::Nodes<double> oracle_step(const Model& model, SolverKind solver, double step);

/// How far a step in single precision may be from the oracle, to first order: a node's acceleration is off by
/// at most
///   8 eps (valence + 4) (sum_j k (X + t V (1 + X / l)) + T) / m
/// with X, V the largest coordinate and speed, l the spring's length, t the damping time, and T what
/// its neo-Hookean tets add: V |g| times the change of their stress where F changes by G X, and its rate by G
/// V, G being the sum of their shape gradients' lengths, and the volume term what its stresses and areas
/// change by where nodes move by X (a load adds its force, or its pressure times the square of 2 X, to the
/// sum and one to the valence); its velocity by h times that and its position by h^2 times that, each plus 16
/// eps of its own size. Times the number of passes.
struct StepBounds {
    std::vector<double> position, velocity;
};
StepBounds rounding_bounds(const Model& model, SolverKind solver, double step);

/// The largest error over its bound, over all nodes; infinite where something is not finite. At most 1 is a
/// pass. The fourth components must be the model's exactly.
double worst_error(const Model& model, const StepBounds& bounds, const cpu::Nodes<double>& expected,
                   const std::vector<glm::vec4>& positions, const std::vector<glm::vec4>& velocities);

/// worst_error of one step that cpu::CpuSolver<float> makes from the model's start with each instruction set,
/// against oracle_step.
double worst_simd_error(const Model& model, SolverKind solver, double step);

}  // namespace gelatin::test
