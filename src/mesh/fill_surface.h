#pragma once

#include <string>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Fills a surface with tetrahedra of the size that `settings` names, by the mesher that they name: TetGen
/// (tetrahedralise.h), or the lattice (lattice/fill_with_lattice.h), which also takes surfaces that are not
/// closed. MesherKind::automatic is the lattice
/// - where `cell_size` is set, which is a size of its cells;
/// - where TetGen's tets would have over a fifth more nodes than wanted, or fewer: they keep the surface's
///   vertices;
/// - where TetGen fails, is too slow or is missing;
/// and otherwise TetGen. A note says which and why, unless no size is set and TetGen works.
/// @param name for messages: the object's or the file's
/// @param notes gets a line for each thing that the user should know about the result
/// @throws InvalidInput, SystemError as these do
TetMesh fill_surface(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name,
                     Notes& notes);

/// The settings with a size: kUsualNodes where there is none. For surfaces from files, whose triangles were
/// not made for a simulation.
MesherSettings sized(MesherSettings settings);

}  // namespace gelatin
