#pragma once

#include <filesystem>
#include <vector>

#include "gelatin/scene.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {

struct ReadObjects {
    std::vector<ObjectDescription> objects;
    std::vector<std::size_t> tables;  ///< of each object, the table of its kind that it or its original is in
};

/// @param tables the [[object]] tables
/// @param folder where relative mesh files start
/// @throws InvalidInput for what is no object: keys and types.
ReadObjects read_objects(std::vector<TableReader> tables, const std::vector<Material>& materials,
                         const std::filesystem::path& folder);
/// The same of the [[rigid]] tables.
ReadObjects read_rigids(std::vector<TableReader> tables, const std::vector<Material>& materials,
                        const std::filesystem::path& folder);
/// Both kinds in the order of their lines.
ReadObjects merge_objects(ReadObjects deformable, ReadObjects rigid);

/// @param tables the [[collider]] tables
/// @param collision gives friction and restitution where a collider is silent
/// @param folder where relative mesh files start
std::vector<ColliderDescription> read_colliders(std::vector<TableReader> tables,
                                                const CollisionSettings& collision,
                                                const std::filesystem::path& folder);

}  // namespace gelatin
