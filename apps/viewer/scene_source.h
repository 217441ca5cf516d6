#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin::viewer {

/// A scene and its model: ready to be simulated.
struct LoadedScene {
    Scene scene;
    std::shared_ptr<const Model> model;
};

/// Reads a scene file, or puts a bare mesh above a floor (`scene_of_mesh`), and builds it; without OpenGL, so
/// on any thread.
/// @param overrides as in load_scene, for scene files only @throws InvalidInput
LoadedScene open_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// The same for a scene that was edited.
LoadedScene build_scene(const Scene& scene);

/// A scene in which a surface or a tet mesh falls a short distance onto a floor. A mesh that is much larger
/// or smaller than a metre is scaled to one, because a material that suits one size does not suit another.
/// @throws InvalidInput if it cannot be read
Scene scene_of_mesh(const std::filesystem::path& file);

/// The scenes that come with Gelatin, by name: those of the folder `scenes` here, otherwise those of the
/// sources.
std::vector<std::filesystem::path> sample_scenes();

}  // namespace gelatin::viewer
