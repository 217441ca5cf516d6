#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mesh/tet_mesh.h"

namespace gelatin {

/// Tet meshes kept on disk by a key of everything they depend on. Several processes may share it: entries
/// appear by rename, whole or not at all; a damaged entry is a miss. A folder that cannot be written is a
/// warning, not an error.
class TetCache {
public:
    /// GELATIN_CACHE_DIR, else XDG_CACHE_HOME/gelatin, else ~/.cache/gelatin.
    static std::filesystem::path default_folder();

    explicit TetCache(std::filesystem::path folder = default_folder());
    std::optional<TetMesh> find(const std::string& key) const;
    void store(const std::string& key, const TetMesh& mesh) const;

private:
    std::filesystem::path folder_;
};

}  // namespace gelatin
