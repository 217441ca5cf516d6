#pragma once

#include <filesystem>

#include "mesh/surface_mesh.h"

struct aiScene;

namespace gelatin {

/// Sets the materials of a look whose faces name materials of an Assimp scene, with their images' bytes.
/// Renames them in the faces; Assimp's own material, where a file gives none, becomes SurfaceLook::kNone.
/// @param file of the scene, beside which images are found @param is_gltf its colours are linear, not sRGB
void import_materials(const aiScene& scene, const std::filesystem::path& file, bool is_gltf,
                      SurfaceLook& look, Notes& notes);

}  // namespace gelatin
