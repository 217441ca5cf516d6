#pragma once

#include "mesh/lattice/face_tree.h"
#include "mesh/tet_mesh.h"

namespace gelatin::lattice {

/// Moves nodes of tets with angles between faces under 25 degrees, or above 155, where that improves the
/// worst of the node's tets. No move makes this worst one worse. Nodes of `mesh.faces` stay on the surface of
/// `tree`; those that are not on it, as in its holes, move by at most 0.3 of their shortest edge a sweep.
void improve_tets(TetMesh& mesh, const FaceTree& tree);

}  // namespace gelatin::lattice
