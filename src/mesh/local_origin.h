#pragma once

#include "mesh/surface_mesh.h"

namespace gelatin {

/// Moves a surface near the origin if it is so far away that single precision, in which bodies are simulated,
/// would round its edges by more than a hundredth, and if that helps. A line in `notes` says by how much.
void move_near_origin(SurfaceMesh& mesh, Notes& notes);

}  // namespace gelatin
