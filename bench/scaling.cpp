#include "bench/scaling.h"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>

#include "bench/scaling_report.h"
#include "bench/scaling_result.h"
#include "common/output_file.h"
#include "core/file.h"
#include "gelatin/error.h"
#include "gl/context.h"

namespace gelatin {
namespace {

constexpr double kSlow = 300.0;  // a step that takes longer [ms] ...
constexpr int kSlowRuns = 3;     // ... is sampled this many times

// A measurement in progress.
struct ScalingEntry {
    ScalingResult result;
    std::unique_ptr<StagePlayer> player;
    int runs;
};

class ScalingBenchRun {
public:
    ScalingBenchRun(const ScalingBenchOptions& options, const gl::Context* context)
        : systems_(stage_systems(context != nullptr)) {
        bench_.options = options;
        bench_.machine = describe_bench_machine(context != nullptr ? &context->device() : nullptr);
    }
    /// Builds its model, if any measurement of it is requested, and samples all systems alternately.
    void measure(const ScalingCase& scaling_case);
    ScalingBench take_result() { return std::move(bench_); }

private:
    bool is_wanted(const ScalingCase& scaling_case, const CollisionSettings& method,
                   const StageSystem& system) const {
        return scaling_label(scaling_case, method, system).find(bench_.options.only) != std::string::npos;
    }
    ScalingEntry make_entry(const ScalingCase& scaling_case, const CollisionSettings& method,
                            const StageSystem& system, const std::shared_ptr<const Model>& model) const;

    ScalingBench bench_;
    std::vector<StageSystem> systems_;
};

ScalingEntry ScalingBenchRun::make_entry(const ScalingCase& scaling_case, const CollisionSettings& method,
                                         const StageSystem& system,
                                         const std::shared_ptr<const Model>& model) const {
    std::fprintf(stderr, "gelatin: %s\n", scaling_label(scaling_case, method, system).c_str());
    ScalingEntry entry;
    entry.player = std::make_unique<StagePlayer>(model, method, system, scaling_case.stages);
    ScalingResult& result = entry.result;
    result.part = scaling_case.part;
    result.scene = scaling_case.scene;
    result.broad_phase = method.broad_phase;
    result.system = system.name;
    result.objects = model->objects.size();
    result.faces = model->faces.size();
    const StagePlayer::Trial trial = entry.player->try_out();
    result.steps = trial.steps;
    entry.runs = trial.ms > kSlow ? std::min(kSlowRuns, bench_.options.runs) : bench_.options.runs;
    return entry;
}

void ScalingBenchRun::measure(const ScalingCase& scaling_case) {
    std::shared_ptr<const Model> model;
    double loading = 0.0;
    std::vector<ScalingEntry> entries;
    for (const CollisionSettings& method : scaling_case.methods) {
        for (const StageSystem& system : systems_) {
            if (!is_wanted(scaling_case, method, system)) continue;
            if (!model) {
                const auto start = std::chrono::steady_clock::now();
                model = scaling_case.make_model();
                loading = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            }
            entries.push_back(make_entry(scaling_case, method, system, model));
            entries.back().result.loading = loading;
        }
    }
    for (int run = 0; run < bench_.options.runs; ++run) {
        for (ScalingEntry& entry : entries)
            if (run < entry.runs) entry.result.samples.push_back(entry.player->sample(entry.result.steps));
    }
    for (ScalingEntry& entry : entries) {
        const Measurement measured = entry.player->measure();
        for (const ObjectMeasure& object : measured.objects)
            entry.result.colliding_faces += object.colliding_faces;
        entry.result.lost_pairs = measured.lost_pairs;
        bench_.results.push_back(std::move(entry.result));
    }
}

}  // namespace

void bench_scaling(const ScalingBenchOptions& options) {
    if (!options.json.empty()) check_output_file("--json", options.json);
    if (!options.report.empty()) check_output_file("--report", options.report, {".md"});
    std::optional<gl::Context> context;
    if (options.use_gl) context = gl::Context::headless();
    ScalingBenchRun run(options, context ? &*context : nullptr);
    const std::vector<ScalingCase> cases = scaling_cases(options);
    for (const ScalingCase& scaling_case : cases) run.measure(scaling_case);
    const ScalingBench bench = run.take_result();
    if (bench.results.empty()) {
        throw InvalidInput(
            {{},
             0,
             "--only",
             options.only,
             "is part of no measurement's name, such as \"" +
                 scaling_label(cases.front(), cases.front().methods.front(), stage_systems(false).front()) +
                 "\""});
    }
    fmt::print(message_stream({options.json, options.report}), "{}", scaling_tables(bench));
    if (!options.json.empty()) write_file(options.json, scaling_json(bench));
    if (!options.report.empty()) write_scaling_report(options.report, bench);
}

}  // namespace gelatin
