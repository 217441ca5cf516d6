#pragma once

#include <array>

#include "gelatin/scene.h"

namespace gelatin {

/// An explicit integrator as passes over the nodes; one table drives the CPU, the GPU and the stability
/// bound.
///
/// With y = (x, v), f(y) = (v, a(x, v)) and base y0, each pass evaluates f at its point y_p (y_0 first) and
///   sum += weight f(y_p),   y_{p+1} = y0 + h next f(y_p);
/// after the last one y = y0 + h sum. Semi-implicit Euler moves x with the new v instead.
struct ExplicitScheme {
    struct Pass {
        double weight;
        double next;
    };
    int pass_count;
    std::array<Pass, 4> passes;
    bool semi_implicit;
};

const ExplicitScheme& explicit_scheme(SolverKind solver);

}  // namespace gelatin
