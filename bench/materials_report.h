#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/beam_bench.h"
#include "bench/machine.h"
#include "bench/materials.h"
#include "bench/samples.h"

namespace gelatin {

/// The steps of one material by one solver on one system.
struct MaterialTime {
    std::string material, solver, system;
    double step;                  ///< its size [s]
    std::vector<double> samples;  ///< [ms a step]
    std::vector<double> ratios;   ///< of each to the first material's sample beside it

    double ratio() const { return summarise(ratios).median; }
};

/// One run of `gelatin bench materials`.
struct MaterialBench {
    MaterialBenchOptions options;
    BenchMachine machine;
    std::vector<MaterialTime> materials;
    BeamBench beam;
};

/// All figures as Markdown that is also legible as plain text.
std::string material_tables(const MaterialBench& bench);

/// One JSON object; docs/command-line.md lists its keys.
std::string material_json(const MaterialBench& bench);

/// Writes the tables with everything that they depend on, but no date, to `file` (.md). @throws SystemError
void write_material_report(const std::filesystem::path& file, const MaterialBench& bench);

}  // namespace gelatin
