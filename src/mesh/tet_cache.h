#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/disk_cache.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// What a mesher made, and what it said about that.
struct CachedTets {
    TetMesh mesh;
    Notes notes = {};
};

/// Tet meshes stored on disk under a key of everything that they depend on (disk_cache.h).
class TetCache {
public:
    explicit TetCache(std::filesystem::path folder = DiskCache::default_folder());
    std::optional<CachedTets> find(const std::string& key) const;
    void store(const std::string& key, const CachedTets& tets) const;

private:
    DiskCache cache_;
};

}  // namespace gelatin
