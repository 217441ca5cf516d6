#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gelatin {

struct PaperBenchOptions {
    std::filesystem::path scenes;  ///< folder of free_fall.toml and collision.toml; empty: search for it
    std::optional<int> frames;     ///< of a run; empty: the scene's
    int runs = 10;                 ///< runs of each system; the mean is reported
    double whole_limit = 60.0;     ///< longer runs are sampled [s]
    int windows = 40;              ///< of a sampled run
    int window_frames = 2;
    std::string only;                    ///< part of the labels to measure; empty: all
    std::filesystem::path json, report;  ///< files; empty: none
};

/// Measures the paper's two simulations (4.2) as in its Tables 3 and 4, with the paper's algorithms and the
/// fast ones, and prints the frames per second beside the paper's.
///
/// @throws InvalidInput for missing scenes or `only` that matches nothing; NoOpenGl without OpenGL.
void bench_paper(const PaperBenchOptions& options);

}  // namespace gelatin
