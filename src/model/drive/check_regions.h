#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Checks an object's pins, handles and loads against its mesh.
/// @param file of the scene, for messages @param held the nodes of each handle
/// @throws InvalidInput for a region without nodes, or without faces if a load acts on faces; and for a node
///   that two handles hold, or a handle and a pin, unless both rest for ever.
void check_regions(const std::filesystem::path& file, const ObjectDescription& object, const TetMesh& mesh,
                   const std::vector<std::vector<std::uint32_t>>& held);

}  // namespace gelatin
