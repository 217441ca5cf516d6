#pragma once

#include <filesystem>
#include <string>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// Reads triangles through Assimp, in single precision, without any repair. Of OBJ and glTF files also how
/// they look: texture coordinates, materials, and images. Those that cannot be read are left out, with a line
/// in `notes`. The transforms of a glTF file's nodes are applied.
/// @param ending of the format: ".obj", ".stl", ".ply", ".off", ".gltf", ".glb"
/// @param content of the file, already checked; further files are found beside `file`
/// @throws InvalidInput if Assimp refuses it, for coordinates that are not finite and indices out of range
SurfaceMesh import_surface(const std::filesystem::path& file, const std::string& ending,
                           const std::string& content, Notes& notes);

}  // namespace gelatin
