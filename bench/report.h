#pragma once

#include <filesystem>
#include <string>

#include "bench/result.h"

namespace gelatin {

/// Frames per second of every system, one table for each scene, and the ratios, as Markdown that is also
/// legible as plain text.
std::string bench_tables(const PaperBench& bench);

/// One JSON object; docs/command-line.md lists its keys.
std::string bench_json(const PaperBench& bench);

/// Writes the tables with all that they depend on, but no date, to `file` (.md). It shows the picture of its
/// name (.svg), which scripts/plot_bench draws of the JSON file of its name.
/// @throws SystemError
void write_bench_report(const std::filesystem::path& file, const PaperBench& bench);

}  // namespace gelatin
