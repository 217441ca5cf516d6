#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/paper.h"
#include "bench/paper_cases.h"

namespace gelatin {

/// Of the runs of one measurement [frames/s].
struct BenchSpread {
    double mean, standard_deviation, least, most;
};

/// The measurement of one system with one scene.
struct BenchResult {
    std::size_t scene;  ///< index of bench_scenes()
    BenchSystem system;
    bool drawn;
    std::string backend, device;  ///< the device that simulated
    bool sampled = false;
    int window_count = 1, window_frames = 0;  ///< one window of all frames if it was not sampled
    std::vector<double> fps;                  ///< of each run [frames/s]

    BenchSpread spread() const;
    double paper_fps() const { return system.paper_fps[scene]; }
};

/// "free fall, paper, GPU, drawn": the text that `--only` searches.
std::string bench_label(std::size_t scene, const BenchSystem& system, bool drawn);

struct BenchSceneFacts {
    std::size_t scene;
    Counts counts;
    int frames;
    int contact_free_frames;
};

/// One run of `gelatin bench paper`.
struct PaperBench {
    PaperBenchOptions options;
    BenchMachine machine;
    std::string picture;
    std::vector<BenchSceneFacts> scenes;
    std::vector<BenchResult> results;

    const BenchResult* find(std::size_t scene, const std::string& system, bool drawn) const;

    /// The ratio of the means; empty if one was not measured.
    std::optional<double> ratio(std::size_t scene, const BenchComparison& comparison, bool drawn) const;
};

}  // namespace gelatin
