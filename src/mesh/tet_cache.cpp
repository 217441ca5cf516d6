#include "mesh/tet_cache.h"

#include <utility>

#include "core/packed_arrays.h"

namespace gelatin {

static_assert(sizeof(glm::dvec3) == 24 && sizeof(glm::uvec4) == 16 && sizeof(glm::uvec3) == 12);

TetCache::TetCache(std::filesystem::path folder) : cache_(std::move(folder), "tets") {}

std::optional<TetMesh> TetCache::find(const std::string& key) const {
    const std::optional<std::string> bytes = cache_.find(key);
    if (!bytes) return std::nullopt;
    ArrayReader reader(*bytes);
    TetMesh mesh;
    const bool is_whole = reader.take(mesh.positions) && reader.take(mesh.tets) && reader.take(mesh.faces) &&
                          reader.take(mesh.attributes);
    return is_whole && reader.at_end() ? std::optional(std::move(mesh)) : std::nullopt;
}

void TetCache::store(const std::string& key, const TetMesh& mesh) const {
    ArrayWriter writer;
    writer.add(mesh.positions);
    writer.add(mesh.tets);
    writer.add(mesh.faces);
    writer.add(mesh.attributes);
    cache_.store(key, writer.bytes());
}

}  // namespace gelatin
