#pragma once

#include <vector>

#include "model/solver.h"
#include "support/step_on_gpu.h"

namespace gelatin::test {

struct Descent {
    double step;  ///< [s]
    DescentSettings settings{};
    std::vector<glm::vec4> earlier_velocities{};  ///< empty: none
    std::vector<glm::vec4> positions{};           ///< at the start; empty: the model's
};

/// The model's positions with every body rotated about its middle by 120 degrees.
std::vector<glm::vec4> rotated_start(const Model& model);

/// A step of vertex block descent on the GPU from the model's start, positions and velocities poisoned first
/// and guarded behind their end.
NodeArrays descend_on_gpu(const Model& model, const Descent& descent);

/// The largest error of its nodes against the double reference, over a bound; infinite where something is not
/// finite. A sweep solves H d = f with f off by as much as rounding_bounds says of a step's forces, and H at
/// least m / h^2: h^2 times the acceleration's bound, and that once a sweep, for sweeps contract.
double worst_descent_error(const Model& model, const Descent& descent, const NodeArrays& actual);

/// A step of two nodes that start in one place at one speed, one they are tied to, and one without springs:
/// how far the GPU's is from the double reference, over what rounding may make of it.
double degenerate_descent_error(int iterations);

/// The same of a block on a slope that starts squeezed by 2% in height, so that its nodes find far more than
/// its weight on the floor, and too much friction.
double sliding_descent_error();

/// Bodies in all states that block descent distinguishes: free ones in motion, shaken so much that tets are
/// inside out, one of them of two chunks of nodes; one with pins; one on a floor and against a sphere; with
/// damping or without; of any Poisson's ratio. All but the second are made of `model`, that one of springs.
/// Driven: loads pull and press at the first, and a moving handle holds the second.
Model make_bodies_to_descend(double damping_time, double poisson_ratio = 0.25,
                             MaterialModel model = MaterialModel::mass_spring, bool driven = false);

}  // namespace gelatin::test
