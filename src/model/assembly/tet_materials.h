#pragma once

#include <cstdint>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// The part of the object that each tet belongs to: 0 for none, p + 1 for parts[p]; the last one if there are
/// several. Empty if there are no parts.
/// @param mesh as placed in the scene
/// @param file the scene's, for messages
/// @throws InvalidInput for a part without tets
std::vector<std::uint32_t> choose_tet_materials(const ObjectDescription& object, const TetMesh& mesh,
                                                const std::string& file);

}  // namespace gelatin
