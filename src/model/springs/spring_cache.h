#pragma once

#include <filesystem>

#include "core/disk_cache.h"
#include "model/springs/fit_springs.h"

namespace gelatin {

/// Fitted springs, stored on disk with the mesh to which they were fitted as the key (disk_cache.h).
class SpringCache {
public:
    explicit SpringCache(std::filesystem::path folder = DiskCache::default_folder());

    /// fit_springs(mesh), or its stored result.
    FittedSprings fit(const TetMesh& mesh) const;

private:
    DiskCache cache_;
};

}  // namespace gelatin
