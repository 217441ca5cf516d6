#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/kernels.h"
#include "bench/machine.h"
#include "bench/ratios.h"
#include "bench/samples.h"

namespace gelatin {

/// The measurement of one stage on one backend at one size.
struct KernelTime {
    std::string backend, stage;
    int scale;
    BenchSummary ms;
    double least;  ///< of all samples [ms]
    double bytes;  ///< read and written at least once
    double springs;
};

struct KernelBench {
    KernelBenchOptions options;
    BenchMachine machine;
    std::vector<KernelTime> times;

    /// The important ratios.
    std::vector<BenchRatio> ratios() const;
};

/// All times, and the ratios, as Markdown that is also legible as plain text.
std::string kernel_tables(const KernelBench& bench);

/// One JSON object; docs/command-line.md lists its keys.
std::string kernel_json(const KernelBench& bench);

/// Writes the tables with everything that they depend on, but no date, to `file` (.md). @throws SystemError
void write_kernel_report(const std::filesystem::path& file, const KernelBench& bench);

}  // namespace gelatin
