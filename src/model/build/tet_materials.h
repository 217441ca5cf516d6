#pragma once

#include <cstdint>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Which part of the object each tet is of: 0 where none, p + 1 for parts[p]; of several the last. Empty if
/// there are no parts.
/// @param mesh where the scene puts it
/// @param file the scene's, for messages
/// @throws InvalidInput for a part without tets
std::vector<std::uint32_t> choose_tet_materials(const ObjectDescription& object, const TetMesh& mesh,
                                                const std::string& file);

}  // namespace gelatin
