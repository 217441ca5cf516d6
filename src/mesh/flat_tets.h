#pragma once

#include <cstddef>

#include "mesh/tet_mesh.h"

namespace gelatin {

/// True if the volume of a tet is below 1e-12 of its longest edge cubed, whatever its sign.
bool is_flat(const TetMesh& mesh, const glm::uvec4& tet);

/// Removes flat tets with one or two faces on the boundary. Mesh generators leave them where four points of a
/// plane facet are coplanar except for rounding. The tets behind them cover what they covered, and every node
/// keeps a tet. Does not change `mesh.faces`.
/// @returns the number of flat tets that remain
std::size_t drop_flat_skin(TetMesh& mesh);

}  // namespace gelatin
