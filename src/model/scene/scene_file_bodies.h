#pragma once

#include <filesystem>
#include <vector>

#include "gelatin/scene.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {

/// @param tables the [[object]] tables
/// @param folder where relative mesh files start
/// @throws InvalidInput for anything wrong in them, names that are there twice, or a material that
/// `materials` lacks.
std::vector<ObjectDescription> read_objects(std::vector<TableReader> tables,
                                            const std::vector<Material>& materials,
                                            const std::filesystem::path& folder);

/// @param tables the [[collider]] tables
/// @param collision gives friction and restitution where a collider is silent
std::vector<ColliderDescription> read_colliders(std::vector<TableReader> tables,
                                                const CollisionSettings& collision);

}  // namespace gelatin
