#pragma once

#include <filesystem>
#include <string>

#include "bench/scaling_result.h"

namespace gelatin {

/// One table for each part, and the ratios, as Markdown that is also legible as plain text.
std::string scaling_tables(const ScalingBench& bench);

/// One JSON object; docs/command-line.md lists its keys.
std::string scaling_json(const ScalingBench& bench);

/// Writes the tables with all that they depend on, but no date, to `file` (.md). It shows the picture of its
/// name (.svg), which scripts/plot_bench draws of the JSON file of its name.
/// @throws SystemError
void write_scaling_report(const std::filesystem::path& file, const ScalingBench& bench);

}  // namespace gelatin
