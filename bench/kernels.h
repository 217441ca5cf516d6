#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gelatin {

struct KernelBenchOptions {
    std::vector<int> scales{1, 10, 100};  ///< multiples of three spheres of frequency 20
    int runs = 15;                        ///< samples of each stage; the median is reported
    bool use_gl = true;
    std::filesystem::path json, report;  ///< empty: none
};

/// Times each stage on each backend, alternately within one run. Prints a table with milliseconds, the bytes
/// that a stage must move at least, and their rate; then the important ratios.
/// @throws InvalidInput for files that cannot be written; SystemError
void bench_kernels(const KernelBenchOptions& options);

}  // namespace gelatin
