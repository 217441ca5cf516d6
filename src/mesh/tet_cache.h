#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/disk_cache.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Tet meshes stored on disk under a key of everything that they depend on (disk_cache.h).
class TetCache {
public:
    explicit TetCache(std::filesystem::path folder = DiskCache::default_folder());
    std::optional<TetMesh> find(const std::string& key) const;
    void store(const std::string& key, const TetMesh& mesh) const;

private:
    DiskCache cache_;
};

}  // namespace gelatin
