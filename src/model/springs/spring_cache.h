#pragma once

#include <filesystem>

#include "core/disk_cache.h"
#include "model/springs/fit_springs.h"

namespace gelatin {

/// Fitted springs, kept on disk with the mesh they were fitted to as their key (disk_cache.h).
class SpringCache {
public:
    explicit SpringCache(std::filesystem::path folder = DiskCache::default_folder());

    /// fit_springs(mesh), or what it gave before.
    FittedSprings fit(const TetMesh& mesh) const;

private:
    DiskCache cache_;
};

}  // namespace gelatin
