#pragma once

#include <filesystem>
#include <string>

namespace gelatin {

/// The path of the scene `name`: in `folder` if that is not empty, otherwise in `scenes` of the current
/// folder, otherwise in that of the sources.
std::filesystem::path find_bench_scene(const std::filesystem::path& folder, const std::string& name);

}  // namespace gelatin
