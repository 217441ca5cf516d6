#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "common/scene_input.h"
#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin::viewer {

/// A scene and its model: ready to be simulated.
struct LoadedScene {
    Scene scene;
    std::shared_ptr<const Model> model;
};

/// Builds a scene's model; without OpenGL, so on any thread. @throws InvalidInput
LoadedScene build_scene(const Scene& scene);

/// The scenes that come with Gelatin, by name: those of the folder `scenes` here, otherwise those of the
/// sources.
std::vector<std::filesystem::path> sample_scenes();

}  // namespace gelatin::viewer
