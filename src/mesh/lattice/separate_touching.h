#pragma once

#include "mesh/tet_mesh.h"

namespace gelatin::lattice {

/// Makes the boundary of tets a manifold. Where tets touch at a node or an edge alone, without common
/// faces, each side gets a node of its own, a little apart. Where they surround an edge on two sides and meet
/// again, the side with fewer tets is removed. Where the outside is narrowed to a point it is opened by
/// removing tets. Removes nodes without tets, sets `faces`.
void separate_touching(TetMesh& mesh);

/// Removes nodes that no tet uses.
void remove_unused_nodes(TetMesh& mesh);

}  // namespace gelatin::lattice
