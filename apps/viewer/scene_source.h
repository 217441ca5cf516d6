#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin::viewer {

/// A scene with what was built of it: ready to be simulated.
struct LoadedScene {
    Scene scene;
    std::shared_ptr<const Model> model;
};

/// Reads a scene file, or puts a bare mesh on a floor (`scene_of_mesh`), and builds it; without OpenGL, so on
/// any thread.
/// @param overrides as load_scene's, of scene files alone @throws InvalidInput
LoadedScene open_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// The same of a scene that was edited.
LoadedScene build_scene(const Scene& scene);

/// A scene that lets a surface or ready tets fall a little way onto a floor. What is much larger or smaller
/// than a metre is scaled to one, for a material that suits the one is no use for the other.
/// @throws InvalidInput if it cannot be read
Scene scene_of_mesh(const std::filesystem::path& file);

/// The scenes that come with Gelatin, by name: those of the folder `scenes` here, else those of the sources.
std::vector<std::filesystem::path> sample_scenes();

}  // namespace gelatin::viewer
