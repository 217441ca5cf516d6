#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gelatin {

struct ScalingBenchOptions {
    std::vector<int> faces{8000, 32000, 128000, 512000, 1310000};  ///< of a body, about
    std::vector<int> objects{10, 100, 1000, 10000};
    int runs = 9;                  ///< samples of each measurement, of which the median counts
    std::string only;              ///< part of the labels to measure; empty: all
    std::filesystem::path scenes;  ///< folder of free_fall.toml and rain.toml; empty: found
    bool use_gl = true;
    std::filesystem::path json, report;  ///< files; empty: none
};

/// Measures what collision costs by size, on each backend: two bodies through trees and by brute force, from
/// thousands of faces to a million, from ten objects to ten thousand, and undeformed bodies with themselves.
/// Prints tables, and the ratios that matter.
///
/// @throws InvalidInput for `only` that matches nothing and files that cannot be written; NoOpenGl without
/// OpenGL, unless it is left out.
void bench_scaling(const ScalingBenchOptions& options);

}  // namespace gelatin
