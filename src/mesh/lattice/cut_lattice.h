#pragma once

#include <vector>

#include "mesh/lattice/enclosed_space.h"
#include "mesh/lattice/lattice.h"
#include "mesh/tet_mesh.h"

namespace gelatin::lattice {

/// The part of a lattice that is inside, cut along the boundary by isosurface stuffing (Labelle and Shewchuk
/// 2007): points that are close to the boundary move onto it, tets that it still passes through are replaced
/// by their parts inside. All tets have positive volumes. `faces` stays empty, and nodes without tets may
/// remain.
TetMesh cut_lattice(const Lattice& lattice, const EnclosedSpace& space);

}  // namespace gelatin::lattice
