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

StepSettings beam_steps(int iterations) {
    return {SolverKind::implicit, kBeamStep, {iterations}};
}

void time_beams(const std::vector<BeamCase>& beams, const StageSystem& system,
                const MaterialBenchOptions& options, BeamBench& bench) {
    std::fprintf(stderr, "gelatin: beam, %s\n", system.name.c_str());
    std::vector<TimedSteps> steps;
    const std::size_t first = bench.times.size();
    for (const BeamCase& beam : beams) {
        const State start{beam.model->positions, beam.model->velocities, {}};
        for (const int iterations : options.iterations) {
            steps.emplace_back(beam.model, start, system, beam_steps(iterations));
            bench.times.push_back({beam.body, system.name, iterations, {}, 0.0});
        }
    }
    const std::vector<std::vector<double>> samples = sample_in_turn(steps, options.runs);
    for (std::size_t c = 0; c < samples.size(); ++c) bench.times[first + c].samples = samples[c];
}

BeamReference compare_reference(const BeamCase& beam, const std::vector<SampledStep>& steps, int parts) {
    const SampledStep& last = steps.back();
    ExactMotion more(beam.model, kBeamStep, 2 * parts);
    BeamReference reference{beam.body, parts, step_error(last, more.end(last.start)), 0.0};
    for (const SampledStep& step : steps)
        reference.free_error += step_error(step, free_motion(*beam.model, step.start, kBeamStep)) /
                                static_cast<double>(steps.size());
    return reference;
}

// Of all the same steps, since those of the exact motion take long.
void find_errors(const BeamCase& beam, const std::vector<StageSystem>& systems,
                 const MaterialBenchOptions& options, BeamBench& bench) {
    std::fprintf(stderr, "gelatin: beam, errors of %s\n", beam.body.c_str());
    ExactMotion exact(beam.model, kBeamStep, parts_of_step(*beam.model, kBeamStep));
    const StepSettings sampled =
        beam_steps(*std::max_element(options.iterations.begin(), options.iterations.end()));
    const std::vector<SampledStep> steps = sample_steps(beam.model, sampled, kMoments, exact);
    bench.references.push_back(compare_reference(beam, steps, exact.parts()));
    for (BeamTime& time : bench.times) {
        if (time.body != beam.body) continue;
        const auto system = std::find_if(systems.begin(), systems.end(),
                                         [&](const StageSystem& s) { return s.name == time.system; });
        time.error = mean_step_error(beam.model, beam_steps(time.iterations), *system, steps);
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
