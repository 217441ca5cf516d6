#pragma once

#include <filesystem>

#include "gelatin/scene.h"

namespace gelatin {

/// Writes a scene file that load_scene makes the same scene of, copies one by one; whole or not at all.
/// @throws SystemError if it cannot be written.
void save_scene(const std::filesystem::path& file, const Scene& scene);

}  // namespace gelatin
