#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin {

/// Names a scene's meshes in memory as if they were files in `folder`, so that it can be written as a scene
/// file. @return these meshes, each once, for restore_meshes
std::vector<std::shared_ptr<const Mesh>> name_meshes(Scene& scene, const std::filesystem::path& folder);

/// Has the meshes in a scene that was read from such a file instead of their names.
void restore_meshes(Scene& scene, const std::vector<std::shared_ptr<const Mesh>>& meshes);

}  // namespace gelatin
