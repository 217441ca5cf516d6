#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/scene/scene_of_meshes.h"

namespace gelatin {

/// What a user wants to simulate: a scene file, meshes without one, or the scene of a recording.
struct SceneInput {
    std::vector<std::filesystem::path> files;  ///< one scene, or meshes, or one recording
    std::vector<std::string> overrides = {};   ///< as load_scene's
    MeshSceneOptions meshes = {};              ///< for meshes only

    bool operator==(const SceneInput&) const = default;
};

/// Whether it is a recording by its name.
bool is_recording_input(const SceneInput& input);

/// Checks what the names of the files and the options say.
/// @throws InvalidInput for no file, files of other kinds, scenes and recordings beside other files, and
/// options of meshes for others
void check_input(const SceneInput& input);

/// The scene of an input. How meshes are scaled is logged.
/// @throws InvalidInput as check_input, load_scene, scene_of_meshes and Recording do
Scene load_input(const SceneInput& input);

}  // namespace gelatin
