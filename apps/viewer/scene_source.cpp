#include "scene_source.h"

#include <algorithm>

#include "model/build/build_model.h"

namespace gelatin::viewer {

LoadedScene build_scene(const Scene& scene) {
    return {scene, std::make_shared<const Model>(build_model(scene))};
}

std::vector<std::filesystem::path> sample_scenes() {
    std::filesystem::path folder = "scenes";
    if (!std::filesystem::is_directory(folder)) folder = GELATIN_SCENES;
    std::vector<std::filesystem::path> files;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace gelatin::viewer
