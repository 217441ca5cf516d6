#pragma once

#include <cstddef>

#include "mesh/tet_mesh.h"

namespace gelatin {

/// True if the volume of a tet is below 1e-12 of its longest edge cubed, whatever its sign.
bool is_flat(const TetMesh& mesh, const glm::uvec4& tet);

/// Drops flat tets that lie on the boundary with one or two of their faces, which mesh generators leave where
/// four points of a plane facet are in one plane but for rounding. What they covered is covered by the tets
/// behind them, and every node keeps a tet. Does not touch `mesh.faces`.
/// @returns the number of flat tets that are left
std::size_t drop_flat_skin(TetMesh& mesh);

}  // namespace gelatin
