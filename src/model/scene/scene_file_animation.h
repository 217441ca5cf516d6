#pragma once

#include <filesystem>

#include "gelatin/scene.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {

/// A collider's `animation`, which it finishes. @param folder of the scene's file
AnimationDescription read_animation(TableReader reader, const std::filesystem::path& folder);

/// An object's `skeleton`, which it finishes.
SkeletonDescription read_skeleton(TableReader reader, const std::filesystem::path& folder);

}  // namespace gelatin
