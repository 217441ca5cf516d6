#pragma once

#include <filesystem>
#include <string>

#include "bench/contact_result.h"

namespace gelatin {

/// Times, dispatches, bytes and ratios, as Markdown that is also legible as plain text.
std::string contact_tables(const ContactBench& bench);

/// One JSON object; docs/benchmarks.md lists its keys.
std::string contact_json(const ContactBench& bench);

/// Writes the tables with all that they depend on, but no date, to `file` (.md). It shows the picture of its
/// name (.svg), which scripts/plot_bench draws of the JSON file of its name.
/// @throws SystemError
void write_contact_report(const std::filesystem::path& file, const ContactBench& bench);

}  // namespace gelatin
