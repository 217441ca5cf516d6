#include "bench/materials.h"

#include <fmt/core.h>

#include <cstdio>
#include <optional>

#include "bench/material_cases.h"
#include "bench/materials_report.h"
#include "common/output_file.h"
#include "core/file.h"
#include "gl/context.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

std::vector<double> divided(const std::vector<double>& samples, const std::vector<double>& others) {
    std::vector<double> ratios;
    for (std::size_t s = 0; s < samples.size(); ++s) ratios.push_back(samples[s] / others[s]);
    return ratios;
}

// All materials, in turn.
void measure_materials(const std::vector<MaterialCase>& cases, SolverKind solver, const StageSystem& system,
                       MaterialBench& bench) {
    std::fprintf(stderr, "gelatin: materials, %s, %s\n", name_of(solver), system.name.c_str());
    std::vector<TimedSteps> steps;
    for (const MaterialCase& c : cases) steps.emplace_back(c.model, c.start(), system, c.settings(solver));
    const std::vector<std::vector<double>> samples = sample_in_turn(steps, bench.options.runs);
    for (std::size_t c = 0; c < cases.size(); ++c) {
        bench.materials.push_back({cases[c].material, name_of(solver), system.name,
                                   cases[c].settings(solver).step, samples[c],
                                   divided(samples[c], samples.front())});
    }
}

}  // namespace

void bench_materials(const MaterialBenchOptions& options) {
    if (!options.json.empty()) check_output_file("--json", options.json);
    if (!options.report.empty()) check_output_file("--report", options.report, {".md"});
    std::optional<gl::Context> context;
    if (options.use_gl) context = gl::Context::headless();
    MaterialBench bench{options, describe_bench_machine(context ? &context->device() : nullptr), {}, {}};
    const std::vector<MaterialCase> cases = material_cases(options.frequency);
    for (const SolverKind solver : {SolverKind::implicit, SolverKind::semi_implicit_euler}) {
        for (const StageSystem& system : material_systems(options.use_gl))
            measure_materials(cases, solver, system, bench);
    }
    bench.beam = measure_beam(options);
    fmt::print(message_stream({options.json, options.report}), "{}", material_tables(bench));
    if (!options.json.empty()) write_file(options.json, material_json(bench));
    if (!options.report.empty()) write_material_report(options.report, bench);
}

}  // namespace gelatin
