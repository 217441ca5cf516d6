#pragma once

#include <string>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// tetrahedralise() with the largest volume of a tet that gives about `nodes` nodes, found in a few tries.
/// The number may differ: TetGen keeps the vertices of the surface, so that there are never fewer.
/// @param settings `max_volume` is ignored
/// @throws as tetrahedralise()
TetMesh tetrahedralise_to_nodes(const SurfaceMesh& surface, MesherSettings settings, int nodes,
                                const std::string& name);

}  // namespace gelatin
