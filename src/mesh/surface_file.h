#pragma once

#include <filesystem>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// Reads an OBJ, STL, PLY or OFF file through Assimp, in single precision, and mends it (surface_repair.h);
/// one line a repair goes to `notes`. Vertices that STL repeats by its nature are merged without one.
/// @throws InvalidInput for a missing, empty, unreadable or unknown file, coordinates that are not finite,
///   indices out of range, counts that the file is too short for (checked before anything of that size is
///   allocated), or no faces at all.
SurfaceMesh read_surface(const std::filesystem::path& file, Notes& notes);

/// Writes by the ending of `file`: .obj, .stl (binary), .ply (binary), .off; whole or not at all.
/// @throws InvalidInput for an unknown ending; SystemError if it cannot be written.
void write_surface(const std::filesystem::path& file, const SurfaceMesh& mesh);

}  // namespace gelatin
