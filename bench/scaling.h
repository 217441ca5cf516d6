#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gelatin {

struct ScalingBenchOptions {
    std::vector<int> faces{8000, 32000, 128000, 512000, 1310000};  ///< of a body, approximately
    std::vector<int> objects{10, 100, 1000, 10000};
    int runs = 9;                  ///< samples of each measurement; the median is reported
    std::string only;              ///< part of the labels to measure; empty: all
    std::filesystem::path scenes;  ///< folder of free_fall.toml and rain.toml; empty: search for it
    bool use_gl = true;
    std::filesystem::path json, report;  ///< files; empty: none
};

/// Measures the cost of collision by size, on each backend: two bodies through trees and by brute force, from
/// thousands of faces to a million, from ten objects to ten thousand, and undeformed bodies with themselves.
/// Prints tables, and the important ratios.
///
/// @throws InvalidInput for `only` that matches nothing and files that cannot be written; NoOpenGl without
///   OpenGL, unless it is excluded.
void bench_scaling(const ScalingBenchOptions& options);

}  // namespace gelatin
