#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin {

/// What a scene has in memory, each once.
struct InMemory {
    using Frames = std::shared_ptr<const std::vector<std::vector<glm::dvec3>>>;

    std::vector<std::shared_ptr<const Mesh>> meshes;
    std::vector<Frames> frames;  ///< of AnimationFrames
};

/// Names what a scene has in memory as if it were files in `folder`, so that it can be written as a scene
/// file.
/// @return this, for restore_meshes
InMemory name_meshes(Scene& scene, const std::filesystem::path& folder);

/// Has it in a scene that was read from such a file instead of the names.
void restore_meshes(Scene& scene, const InMemory& in_memory);

}  // namespace gelatin
