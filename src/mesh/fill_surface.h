#pragma once

#include <string>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Fills a surface with tetrahedra by the mesher that `settings` names: TetGen (tetrahedralise.h), or the
/// lattice (lattice/fill_with_lattice.h), which also takes surfaces that are not closed.
/// MesherKind::automatic is TetGen, and the lattice where TetGen fails or is missing; a note tells why.
/// @param name for messages: the object's or the file's
/// @param notes gets a line for each thing that the user should know about the result
/// @throws InvalidInput, SystemError as these do
TetMesh fill_surface(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name,
                     Notes& notes);

}  // namespace gelatin
