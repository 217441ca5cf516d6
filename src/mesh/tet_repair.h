#pragma once

#include <string>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Nodes that are nearer to each other coincide; of the diagonal of all nodes.
constexpr double kCoincidentNodes = 1e-12;

/// Makes tets as somebody wrote them usable: discards unused nodes and duplicate tets, merges nodes that
/// coincide, flips inverted tets, and computes the boundary faces. Attributes that are all 0 are removed.
/// Adds one line to `notes` for each kind of repair that changed something, and for what is suspicious.
/// @param name of the file or the object, for messages
/// @pre indices are in range and coordinates finite
/// @throws InvalidInput for flat tets (volume below 1e-12 of the longest edge cubed)
void repair_tets(TetMesh& mesh, const std::string& name, Notes& notes);

}  // namespace gelatin
