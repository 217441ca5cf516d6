#include "bench/paper.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "bench/player.h"
#include "bench/report.h"
#include "bench/result.h"
#include "bench/scene_file.h"
#include "bench/windows.h"
#include "common/output_file.h"
#include "common/progress.h"
#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

// This many of a sample's windows, evenly distributed, are used to estimate the duration of a whole run.
constexpr std::size_t kProbes = 10;

// A measurement in progress.
struct Entry {
    BenchResult result;
    BenchPlayer* player;
    std::vector<BenchWindow> windows;
};

void check_outputs(const PaperBenchOptions& options) {
    if (!options.json.empty()) check_output_file("--json", options.json);
    if (!options.report.empty()) check_output_file("--report", options.report, {".md"});
}

double mean_frame_time(const Entry& entry, const std::vector<BenchWindow>& windows) {
    double seconds = 0.0;
    int frames = 0;
    for (const BenchWindow& window : windows) {
        seconds += entry.player->time_window(window, entry.result.drawn);
        frames += window.frames;
    }
    return seconds / frames;
}

class PaperBenchRun {
public:
    explicit PaperBenchRun(const PaperBenchOptions& options);
    void prepare_scene(std::size_t scene_index);
    void time_entries();
    PaperBench take_result();

private:
    std::vector<bool> wanted_drawn(std::size_t scene, const BenchSystem& system) const;
    void add_entry(std::size_t scene, const BenchSystem& system, bool drawn, const BenchWindows& windows);

    PaperBench bench_;
    gl::Context context_;  // declared before everything that owns GL objects
    std::vector<BenchSystem> systems_;
    std::vector<std::unique_ptr<TemporaryFolder>> folders_;  // of the windows' states, by scene
    std::vector<std::unique_ptr<BenchPlayer>> players_;
    std::vector<Entry> entries_;
};

PaperBenchRun::PaperBenchRun(const PaperBenchOptions& options)
    : context_(gl::Context::headless()), systems_(bench_systems(context_.device().is_software)) {
    bench_.options = options;
    bench_.machine = describe_bench_machine(&context_.device());
    bench_.picture = describe_bench_picture();
}

// Whether a system is measured drawn, undrawn, both or not at all.
std::vector<bool> PaperBenchRun::wanted_drawn(std::size_t scene, const BenchSystem& system) const {
    std::vector<bool> wanted;
    for (const bool drawn : {true, false}) {
        if (bench_label(scene, system, drawn).find(bench_.options.only) != std::string::npos)
            wanted.push_back(drawn);
    }
    return wanted;
}

void PaperBenchRun::prepare_scene(std::size_t scene_index) {
    const PaperBenchOptions& options = bench_.options;
    const auto is_wanted = [&](const BenchSystem& system) {
        return !wanted_drawn(scene_index, system).empty();
    };
    if (std::none_of(systems_.begin(), systems_.end(), is_wanted)) return;

    const Scene scene = load_scene(find_bench_scene(options.scenes, bench_scenes()[scene_index].file));
    const int frames = options.frames.value_or(scene.simulation.frames);
    if (frames == 0)
        throw InvalidInput({scene.file.string(), 0, "simulation.frames", "0", "nothing to time"});
    folders_.push_back(std::make_unique<TemporaryFolder>());
    std::fprintf(stderr, "gelatin: %s: saving the states that windows start from\n",
                 bench_scenes()[scene_index].name);
    const BenchWindows windows(scene, frames, options.windows, options.window_frames,
                               folders_.back()->path());
    const std::size_t first_player = players_.size();
    for (const BenchSystem& system : systems_) {
        if (!is_wanted(system) || windows.frames(system.part) == 0) continue;
        players_.push_back(std::make_unique<BenchPlayer>(scene, system));
        for (const bool drawn : wanted_drawn(scene_index, system))
            add_entry(scene_index, system, drawn, windows);
    }
    if (players_.size() == first_player) return;  // no frame before contact, and nothing else requested
    bench_.scenes.push_back({scene_index, players_.back()->simulator().counts(), frames,
                             windows.frames(BenchPart::until_contact)});
}

void PaperBenchRun::add_entry(std::size_t scene, const BenchSystem& system, bool drawn,
                              const BenchWindows& windows) {
    BenchPlayer& player = *players_.back();
    Entry entry;
    BenchResult& result = entry.result;
    result.scene = scene;
    result.system = system;
    result.drawn = drawn;
    result.backend = player.simulator().backend();
    result.device = player.simulator().device();
    entry.player = &player;
    entry.windows = windows.sample(system.part);

    std::vector<BenchWindow> probe;
    const std::size_t stride = std::max<std::size_t>(entry.windows.size() / kProbes, 1);
    for (std::size_t w = 0; w < entry.windows.size(); w += stride) probe.push_back(entry.windows[w]);
    player.time_window(probe.front(), drawn);  // compiles shaders, faults pages in
    const double frame_time = mean_frame_time(entry, probe);
    result.sampled = frame_time * windows.frames(system.part) > bench_.options.whole_limit;
    if (!result.sampled) entry.windows = {windows.whole(system.part)};
    result.window_count = static_cast<int>(entry.windows.size());
    result.window_frames = entry.windows.front().frames;
    const double run_time = frame_time * result.window_count * result.window_frames;
    std::fprintf(stderr, "gelatin: %s: %s, about %s a run\n", bench_label(scene, system, drawn).c_str(),
                 result.sampled ? "sampled" : "whole", describe_duration(run_time).c_str());
    entries_.push_back(std::move(entry));
}

// Alternately, so that a machine that slows down affects all of them.
void PaperBenchRun::time_entries() {
    for (int run = 1; run <= bench_.options.runs; ++run) {
        std::fprintf(stderr, "gelatin: run %d of %d\n", run, bench_.options.runs);
        for (Entry& entry : entries_) entry.result.fps.push_back(1.0 / mean_frame_time(entry, entry.windows));
    }
}

PaperBench PaperBenchRun::take_result() {
    for (Entry& entry : entries_) bench_.results.push_back(std::move(entry.result));
    return std::move(bench_);
}

}  // namespace

void bench_paper(const PaperBenchOptions& options) {
    check_outputs(options);
    PaperBenchRun run(options);
    for (std::size_t s = 0; s < kBenchScenes; ++s) run.prepare_scene(s);
    run.time_entries();
    const PaperBench bench = run.take_result();
    if (bench.results.empty()) {
        throw InvalidInput({{},
                            0,
                            "--only",
                            options.only,
                            "is part of no measurement's name, such as \"" +
                                bench_label(0, bench_systems(true).front(), true) + "\""});
    }
    fmt::print(message_stream({options.json, options.report}), "{}", bench_tables(bench));
    if (!options.json.empty()) write_file(options.json, bench_json(bench));
    if (!options.report.empty()) write_bench_report(options.report, bench);
}

}  // namespace gelatin
