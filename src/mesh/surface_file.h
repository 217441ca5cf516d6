#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// True for the extensions that read_surface supports: .obj, .stl, .ply, .off, .gltf, .glb.
bool is_surface_file(const std::filesystem::path& file);

/// Reads an OBJ, STL, PLY, OFF or glTF file through Assimp, in single precision, and repairs it
/// (surface_repair.h). OBJ and glTF files also say how it looks. Each repair adds one line to `notes`, and
/// each texture that cannot be read. Merging the vertices that STL always repeats adds none.
/// @throws InvalidInput for a missing, empty, unreadable or unknown file, coordinates that are not finite,
///   indices out of range, counts that the file is too short for (checked before anything of that size is
///   allocated), or no faces at all.
SurfaceMesh read_surface(const std::filesystem::path& file, Notes& notes);

/// The vertices of such a file as it has them, before repairs.
/// @throws InvalidInput as read_surface
std::vector<glm::dvec3> read_vertices(const std::filesystem::path& file);

/// Writes in the format of the extension of `file`: .obj, .stl (binary), .ply (binary), .off; completely or
/// not at all.
/// @throws InvalidInput for an unknown extension; SystemError if it cannot be written.
void write_surface(const std::filesystem::path& file, const SurfaceMesh& mesh);

}  // namespace gelatin
