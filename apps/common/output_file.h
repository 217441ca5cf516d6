#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gelatin {

/// Checks, before any work is done, that `file` can be written: its folder exists and is writable, it is not
/// a folder itself, and it has one of `endings` (none: any).
/// @param option for the message: "--video"
/// @throws InvalidInput
void check_output_file(const std::string& option, const std::filesystem::path& file,
                       const std::vector<std::string>& endings = {});

}  // namespace gelatin
