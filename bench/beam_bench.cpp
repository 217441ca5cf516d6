#include "bench/beam_bench.h"

#include <algorithm>
#include <cstdio>

#include "bench/beam.h"
#include "bench/beam_error.h"
#include "bench/stages.h"
#include "bench/timed_steps.h"

namespace gelatin {
namespace {

const std::vector<int> kMoments{10, 25, 50};  // steps after which errors are sampled

StepSettings beam_steps(int sweeps) {
    return {SolverKind::implicit, kBeamStep, {sweeps}};
}

void time_beams(const std::vector<BeamCase>& beams, const StageSystem& system,
                const MaterialBenchOptions& options, BeamBench& bench) {
    std::fprintf(stderr, "gelatin: beam, %s\n", system.name.c_str());
    std::vector<TimedSteps> steps;
    const std::size_t first = bench.times.size();
    for (const BeamCase& beam : beams) {
        const State start{beam.model->positions, beam.model->velocities, {}};
        for (const int sweeps : options.sweeps) {
            steps.emplace_back(beam.model, start, system, beam_steps(sweeps));
            bench.times.push_back({beam.body, system.name, sweeps, {}, 0.0});
        }
    }
    const std::vector<std::vector<double>> samples = sample_in_turn(steps, options.runs);
    for (std::size_t c = 0; c < samples.size(); ++c) bench.times[first + c].samples = samples[c];
}

BeamReference compare_reference(const BeamCase& beam, const std::vector<SampledStep>& steps, int sweeps) {
    ConvergedSteps more(beam.model, kBeamStep, 2 * sweeps);
    BeamReference reference{beam.body, sweeps, 0.0, 0.0};
    for (const SampledStep& step : steps) {
        reference.change = std::max(reference.change, step_error(step, more.end(step.start)));
        reference.free_error += step_error(step, free_motion(*beam.model, step.start, kBeamStep)) /
                                static_cast<double>(steps.size());
    }
    return reference;
}

void find_errors(const BeamCase& beam, const std::vector<StageSystem>& systems,
                 const MaterialBenchOptions& options, BeamBench& bench) {
    ConvergedSteps reference(beam.model, kBeamStep, options.reference_sweeps);
    for (std::size_t s = 0; s < options.sweeps.size(); ++s) {
        const int sweeps = options.sweeps[s];
        std::fprintf(stderr, "gelatin: beam, errors of %s, %d sweeps\n", beam.body.c_str(), sweeps);
        const StepSettings settings = beam_steps(sweeps);
        const std::vector<SampledStep> steps = sample_steps(beam.model, settings, kMoments, reference);
        for (const StageSystem& system : systems) {
            const double error = mean_step_error(beam.model, settings, system, steps);
            for (BeamTime& time : bench.times) {
                if (time.body == beam.body && time.system == system.name && time.sweeps == sweeps)
                    time.error = error;
            }
        }
        if (s == 0) bench.references.push_back(compare_reference(beam, steps, options.reference_sweeps));
    }
}

}  // namespace

BeamBench measure_beam(const MaterialBenchOptions& options) {
    const std::vector<int>& n = options.beam_nodes;
    const std::vector<BeamCase> beams = beam_cases({n[2], n[1], n[0]});
    const std::vector<StageSystem> systems = stage_systems(options.use_gl);
    BeamBench bench;
    for (const StageSystem& system : systems) time_beams(beams, system, options, bench);
    for (const BeamCase& beam : beams) find_errors(beam, systems, options, bench);
    return bench;
}

}  // namespace gelatin
