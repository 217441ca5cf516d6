#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gelatin {

struct PaperBenchOptions {
    std::filesystem::path scenes;  ///< folder of free_fall.toml and collision.toml; empty: found
    std::optional<int> frames;     ///< of a run; empty: the scene's
    int runs = 10;                 ///< of which the mean counts
    double whole_limit = 60.0;     ///< slower runs than this are sampled [s]
    int windows = 40;              ///< of a sampled run
    int window_frames = 2;
    std::string only;                    ///< part of the labels to measure; empty: all
    std::filesystem::path json, report;  ///< files; empty: none
};

/// Measures the paper's two simulations (4.2) as in its Tables 3 and 4, the paper's way and the fast way, and
/// prints the frames a second beside the paper's.
///
/// @throws InvalidInput for scenes that are not there or `only` that matches nothing; NoOpenGl without
/// OpenGL.
void bench_paper(const PaperBenchOptions& options);

}  // namespace gelatin
