#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"

namespace gelatin {

/// How meshes are simulated that come without a scene file.
struct MeshSceneOptions {
    std::optional<Axis> up = {};  ///< which axis of the files points up; empty: z for .stl, y for all others
    bool keep_units = false;      ///< coordinates are metres; otherwise the largest extent becomes 1 m
    std::optional<int> nodes = {};  ///< of each body, as MesherSettings::nodes; for surfaces only

    bool operator==(const MeshSceneOptions&) const = default;
};

/// Whether a file's ending is that of a surface or of a tet mesh.
bool is_mesh_file(const std::filesystem::path& file);

/// A scene of three seconds in which soft bodies drop onto a floor: the first one from half its height, each
/// other from above the one before, a little aside, so that a pile topples. A mesh may be there several
/// times.
/// @param files surfaces or tet meshes, one at least
/// @param notes gets a line for each mesh that is scaled
/// @throws InvalidInput for files that cannot be read, and for options that do not suit them
Scene scene_of_meshes(const std::vector<std::filesystem::path>& files, const MeshSceneOptions& options,
                      Notes& notes);

}  // namespace gelatin
