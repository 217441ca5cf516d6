#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin {

/// The text of a scene file that load_scene makes the same scene of, copies one by one.
/// @param folder of the file: paths of meshes are relative to it
/// @throws InvalidInput for a MeshShape, which no scene file can contain
std::string to_toml(const Scene& scene, const std::filesystem::path& folder);

/// The [[attachment]] tables alone.
std::string to_toml(const std::vector<AttachmentDescription>& attachments);

/// Writes a scene file that load_scene makes the same scene of, copies one by one; whole or not at all.
/// @throws as to_toml; SystemError if it cannot be written.
void save_scene(const std::filesystem::path& file, const Scene& scene);

}  // namespace gelatin
