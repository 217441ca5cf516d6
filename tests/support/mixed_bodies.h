#pragma once

#include "model/model.h"

namespace gelatin::test {

/// Bodies in all states: free ones in motion, shaken so much that tets are inside out, one of them of two
/// chunks of nodes; one with pins; one on a floor and against a sphere; with damping or without; of any
/// Poisson's ratio. All but the second are made of `model`, that one of springs. Driven: loads pull and press
/// at the first, and a moving handle holds the second.
Model make_mixed_bodies(double damping_time, double poisson_ratio = 0.25,
                        MaterialModel model = MaterialModel::mass_spring, bool driven = false);

}  // namespace gelatin::test
