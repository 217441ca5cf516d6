#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/scene/scene_of_meshes.h"

namespace gelatin {

/// What a user wants to simulate: a scene file, or meshes without one.
struct SceneInput {
    std::vector<std::filesystem::path> files;  ///< one scene, or meshes
    std::vector<std::string> overrides = {};   ///< as load_scene's
    MeshSceneOptions meshes = {};              ///< for meshes only

    bool operator==(const SceneInput&) const = default;
};

/// Whether it is a recording by its name, which is played and not simulated.
bool is_recording_input(const SceneInput& input);

/// Checks what the names of the files and the options tell.
/// @throws InvalidInput for no file, recordings, files of other kinds, scenes beside other files, and options
/// of meshes
///   for a scene
void check_input(const SceneInput& input);

/// The scene of an input. How meshes are scaled is logged.
/// @throws InvalidInput as check_input, load_scene and scene_of_meshes do
Scene load_input(const SceneInput& input);

}  // namespace gelatin
