#pragma once

#include <filesystem>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// True for the extensions that read_tets supports: .node, .ele (TetGen), .mesh (Medit), .msh (Gmsh), .vtk,
/// .vtu (VTK).
bool is_tet_file(const std::filesystem::path& file);

/// Reads a tet mesh: TetGen's .node with its .ele (either may be named), Medit's ASCII .mesh, Gmsh's .msh
/// versions 2.2 and 4.1 (ASCII and binary), VTK's unstructured grids as legacy .vtk (ASCII and binary) and as
/// .vtu (all codings, zlib the only compression). Hexahedra, wedges, pyramids and prisms are divided
/// (VolumeCells), elements without volume ignored, duplicate tets and unused nodes discarded, and inverted
/// tets flipped, each with a note. Volume that cannot be read is a warning. Boundary faces are computed.
/// Attributes are the first one of TetGen's, Medit's references, the first of Gmsh's physical groups, and
/// VTK's cell array of integers with a usual name (attribute_rank, vtk_grid.h); none if all are 0.
/// @throws InvalidInput naming file, line and field: missing, empty or truncated, an unknown version, indices
///   out of range, coordinates that are not finite, no tets, flat tets (volume below 1e-12 of the longest
///   edge cubed), counts that the file is too short for (checked before anything of that size is allocated).
TetMesh read_tets(const std::filesystem::path& file, Notes& notes);

/// Writes in the format of the extension: .node (with .ele and .face), .mesh, .msh (4.1 ASCII), .vtu.
/// Completely or not at all.
/// @throws InvalidInput for an unknown extension; SystemError if it cannot be written.
void write_tets(const std::filesystem::path& file, const TetMesh& mesh);

}  // namespace gelatin
