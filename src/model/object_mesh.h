#pragma once

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// The tets of an object where the scene puts it: its shape or file, through the mesher where it is a
/// surface, then scaled, turned and moved. Repairs go to the log, one line each.
/// @throws InvalidInput for files that cannot be read, surfaces that cannot be filled, flat or inverted
/// results.
TetMesh make_object_mesh(const ObjectDescription& object);

}  // namespace gelatin
