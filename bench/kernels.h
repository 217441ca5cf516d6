#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gelatin {

struct KernelBenchOptions {
    std::vector<int> scales{1, 10, 100};  ///< times three spheres of frequency 20
    int runs = 15;                        ///< samples a stage, of which the median counts
    bool use_gl = true;
    std::filesystem::path json, report;  ///< empty: none
};

/// Times each stage on each backend, in turn within one run, and prints a table with milliseconds, the bytes
/// that a stage must move at least, and their rate; then the ratios that matter.
/// @throws InvalidInput for files that cannot be written; SystemError
void bench_kernels(const KernelBenchOptions& options);

}  // namespace gelatin
