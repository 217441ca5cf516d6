#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "gelatin/scene.h"
#include "model/assembly/scene_meshes.h"

namespace gelatin {

/// A scene, with all that its model is made of: nothing else has to be where it is read.
struct RecordedScene {
    std::string text;            ///< as a scene file, in which meshes in memory have names
    std::filesystem::path file;  ///< from which it came; in a folder at least
    std::string meshes;          ///< those in memory, and what all shapes were made into, compressed
};

/// @param meshes of its model; null: its shapes will be made again
RecordedScene recorded_scene(const Scene& scene, const SceneMeshes* meshes);

/// The same scene, to the last bit of its meshes.
/// @throws InvalidInput if it is not what recorded_scene has made; without a file's name for its meshes
Scene restored_scene(const RecordedScene& recorded);

}  // namespace gelatin
