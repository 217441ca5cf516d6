#pragma once

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace gelatin {

/// Checks, before any work is done, that `file` can be written. A regular file, or what a link leads to: its
/// folder is there and takes files, it is no folder itself, and it has one of `endings` (none: any). "-" is
/// standard output, which, as other pipes and devices, may have any name.
/// @param option for the message: "--video"
/// @throws InvalidInput
void check_output_file(const std::string& option, const std::filesystem::path& file,
                       const std::vector<std::string>& endings = {});

/// For formats that go by the name, those of pipes too. @throws InvalidInput
void check_ending(const std::string& option, const std::filesystem::path& file,
                  const std::vector<std::string>& endings);

/// Where people's own messages go: stderr if one of `files` takes stdout, else stdout.
std::FILE* message_stream(std::initializer_list<std::filesystem::path> files);

}  // namespace gelatin
