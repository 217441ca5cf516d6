#include "bench/kernels.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "bench/kernel_cases.h"
#include "bench/kernel_report.h"
#include "bench/threads.h"
#include "common/output_file.h"
#include "core/file.h"
#include "gl/context.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/explicit/stability.h"

namespace gelatin {
namespace {

double time_once(const KernelCase& c, int repeats) {
    const auto start = std::chrono::steady_clock::now();
    for (int r = 0; r < repeats; ++r) c.run();
    c.wait();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    return elapsed.count() / repeats;
}

// Samples the cases alternately, so that a machine that slows down affects all of them.
std::vector<KernelTime> time_cases(const std::vector<KernelCase>& cases, int scale, int runs,
                                   double springs) {
    std::vector<int> repeats;
    for (const KernelCase& c : cases) {
        time_once(c, 1);  // compiles shaders, faults pages in
        repeats.push_back(std::clamp(static_cast<int>(20.0 / std::max(time_once(c, 1), 1e-3)), 1, 200));
    }
    std::vector<std::vector<double>> samples(cases.size());
    for (int r = 0; r < runs; ++r) {
        for (std::size_t c = 0; c < cases.size(); ++c) {
            const ThreadLimit limit(cases[c].threads);
            samples[c].push_back(time_once(cases[c], repeats[c]));
        }
    }
    std::vector<KernelTime> times;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        times.push_back({cases[c].backend, cases[c].stage, scale, summarise(samples[c]),
                         *std::min_element(samples[c].begin(), samples[c].end()), cases[c].bytes, springs});
    }
    return times;
}

}  // namespace

void bench_kernels(const KernelBenchOptions& options) {
    if (!options.json.empty()) check_output_file("--json", options.json);
    if (!options.report.empty()) check_output_file("--report", options.report, {".md"});
    std::optional<gl::Context> context;
    if (options.use_gl) context = gl::Context::headless();
    KernelBench bench{options, describe_bench_machine(context ? &context->device() : nullptr), {}};
    const TetMesh sphere = tetrahedralise(make_sphere({0.5, 20}), MesherSettings{}, "sphere");
    for (const int scale : options.scales) {
        const auto model = make_sphere_grid(sphere, scale);
        const double step = 0.5 * largest_stable_step(SolverKind::semi_implicit_euler, *model);
        const std::vector<KernelCase> cases = kernel_cases(model, step, options.use_gl);
        const std::vector<KernelTime> times =
            time_cases(cases, scale, options.runs, static_cast<double>(model->springs.size()));
        bench.times.insert(bench.times.end(), times.begin(), times.end());
    }
    fmt::print(message_stream({options.json, options.report}), "{}", kernel_tables(bench));
    if (!options.json.empty()) write_file(options.json, kernel_json(bench));
    if (!options.report.empty()) write_kernel_report(options.report, bench);
}

}  // namespace gelatin
