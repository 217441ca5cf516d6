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

/// Why a mesher made none, for an InvalidInput.
struct MesherFailure {
    std::string field = {}, value = {}, problem;
    /// A run with a higher time limit is worth a try [s]: infinite if none is, 0 if any is.
    double retry_above = 0.0;
};

/// Tet meshes and failures stored on disk under a key of everything that they depend on (disk_cache.h).
class TetCache {
public:
    explicit TetCache(std::filesystem::path folder = DiskCache::default_folder());
    std::optional<CachedTets> find(const std::string& key) const;
    void store(const std::string& key, const CachedTets& tets) const;
    std::optional<MesherFailure> find_failure(const std::string& key) const;
    void store_failure(const std::string& key, const MesherFailure& failure) const;

private:
    DiskCache cache_, failures_;
};

}  // namespace gelatin
