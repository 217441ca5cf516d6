#include "model/springs/spring_cache.h"

#include <optional>
#include <utility>

#include "core/content_hash.h"
#include "core/packed_arrays.h"

namespace gelatin {
namespace {

// Part of the key. Increase it when the results of fit_springs change.
constexpr const char* kFormat = "gelatin springs 1";

static_assert(sizeof(UnitSpring) == 16);

std::string make_key(const TetMesh& mesh) {
    ContentHash hash;
    hash.add(std::string(kFormat));
    hash.add(mesh.positions);
    hash.add(mesh.tets);
    hash.add(mesh.faces);
    return hash.hex();
}

std::optional<FittedSprings> decode(const std::string& bytes) {
    ArrayReader reader(bytes);
    FittedSprings fitted;
    std::vector<double> range;
    if (!reader.take(fitted.springs) || !reader.take(range) || range.size() != 2 || !reader.at_end())
        return std::nullopt;
    fitted.softest = range[0];
    fitted.stiffest = range[1];
    return fitted;
}

std::string encode(const FittedSprings& fitted) {
    ArrayWriter writer;
    writer.add(fitted.springs);
    writer.add(std::vector<double>{fitted.softest, fitted.stiffest});
    return writer.bytes();
}

}  // namespace

SpringCache::SpringCache(std::filesystem::path folder) : cache_(std::move(folder), "springs") {}

FittedSprings SpringCache::fit(const TetMesh& mesh) const {
    const std::string key = make_key(mesh);
    if (const std::optional<std::string> bytes = cache_.find(key)) {
        if (std::optional<FittedSprings> known = decode(*bytes)) return std::move(*known);
    }
    FittedSprings fitted = fit_springs(mesh);
    cache_.store(key, encode(fitted));
    return fitted;
}

}  // namespace gelatin
