#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"
#include "model/drive/cavity.h"

namespace gelatin {

/// Its own, or by its place in the object: "cavity 1".
std::string name_of_cavity(const CavityDescription& description, std::size_t index);

/// Finds the hollows of an object's cavities; nodes are the mesh's, and the object is left open.
/// @param file of the scene, for messages
/// @throws InvalidInput unless there is one for each, and for no other one
std::vector<Cavity> make_cavities(const std::filesystem::path& file, const ObjectDescription& object,
                                  const TetMesh& mesh);

}  // namespace gelatin
