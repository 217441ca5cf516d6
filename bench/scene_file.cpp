#include "bench/scene_file.h"

namespace gelatin {

std::filesystem::path find_bench_scene(const std::filesystem::path& folder, const std::string& name) {
    if (!folder.empty()) return folder / name;
    const std::filesystem::path near = std::filesystem::path("scenes") / name;
    return std::filesystem::exists(near) ? near : std::filesystem::path(GELATIN_SCENES) / name;
}

}  // namespace gelatin
