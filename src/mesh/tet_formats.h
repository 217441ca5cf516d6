#pragma once

#include <filesystem>
#include <string>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Nodes and tets as the file has them. Every index is in range and every coordinate finite, but tets may be
/// flat or inverted, nodes unused, and there are no faces yet.
TetMesh read_tetgen(const std::filesystem::path& file, Notes& notes);
TetMesh read_medit(const std::filesystem::path& file, Notes& notes);
TetMesh read_gmsh(const std::filesystem::path& file, Notes& notes);
TetMesh read_vtk(const std::filesystem::path& file, Notes& notes);
TetMesh read_vtu(const std::filesystem::path& file, Notes& notes);

std::string format_tetgen_nodes(const TetMesh& mesh);
std::string format_tetgen_tets(const TetMesh& mesh);
std::string format_tetgen_faces(const TetMesh& mesh);
std::string format_medit(const TetMesh& mesh);
std::string format_gmsh(const TetMesh& mesh);
std::string format_vtu(const TetMesh& mesh);

}  // namespace gelatin
