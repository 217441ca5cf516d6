#pragma once

#include <filesystem>
#include <string>

namespace gelatin {

/// Where the scene `name` is: in `folder` if that is not empty, else in `scenes` of the present folder, else
/// in that of the sources.
std::filesystem::path find_bench_scene(const std::filesystem::path& folder, const std::string& name);

}  // namespace gelatin
