#pragma once

#include <filesystem>
#include <string>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Fills a closed surface with tetrahedra. Runs TetGen as a separate process (`-p -q -a`; paper 2.3) in a
/// private temporary folder, or takes the result from the cache (tet_cache.h): the tets, or the failure of a
/// run whose time limit was not lower. The surface may have several
/// pieces; one that winds inwards is the boundary of a cavity, which stays empty. Faces may be split where
/// the quality requires it. Flat tets that TetGen leaves on the boundary are removed.
/// @param name for messages: the object's or the file's
/// @throws InvalidInput if the surface is not closed (with the number of open edges), or if TetGen fails on
///   it, crashes, leaves flat tets inside or exceeds `settings.time_limit`, with TetGen's message;
///   SystemError if there is no `tetgen` program.
TetMesh tetrahedralise(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name);

}  // namespace gelatin
