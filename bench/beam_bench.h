#pragma once

#include <string>
#include <vector>

#include "bench/materials.h"
#include "bench/samples.h"

namespace gelatin {

/// Steps of SOFA's beam by SolverKind::implicit with a number of iterations on one system.
struct BeamTime {
    std::string body, system;
    int iterations;
    std::vector<double> samples;  ///< [ms a step]
    double error;                 ///< mean_step_error

    double rate() const { return 1e3 / summarise(samples).median; }  ///< [steps/s]
};

/// How well errors are known, and how large they could be.
struct BeamReference {
    std::string body;
    int parts;          ///< of a step of the exact motion
    double change;      ///< of the last of the sampled steps by twice as many parts, relative as errors are
    double free_error;  ///< mean error of the same steps without elastic forces
};

struct BeamBench {
    std::vector<BeamTime> times;
    std::vector<BeamReference> references;
};

/// Times the beam of both materials, each number of iterations in turn on each system, and finds their
/// errors.
BeamBench measure_beam(const MaterialBenchOptions& options);

}  // namespace gelatin
