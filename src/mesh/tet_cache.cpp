#include "mesh/tet_cache.h"

#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <type_traits>
#include <utility>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin {
namespace fs = std::filesystem;

namespace {

/// An entry is this header, then positions, tets and faces as they lie in memory. It is a cache for one
/// machine, so its byte order is the machine's; the magic number fails on another.
struct Header {
    std::uint64_t magic;
    std::uint64_t nodes, tets, faces;
    std::uint64_t checksum[2];  // of the key, the counts and what follows: a renamed entry is a damaged one
};
constexpr std::uint64_t kMagic = 0x3154'4554'4c45'4701;  // "GELTET1" and the format's version

static_assert(sizeof(Header) == 48 && std::is_trivially_copyable_v<Header>);
static_assert(sizeof(glm::dvec3) == 24 && sizeof(glm::uvec4) == 16 && sizeof(glm::uvec3) == 12);

template <class T>
void append(std::string& content, const std::vector<T>& values) {
    const std::size_t begin = content.size();
    content.resize(begin + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(content.data() + begin, values.data(), values.size() * sizeof(T));
}

template <class T>
void take(const char*& from, std::size_t count, std::vector<T>& values) {
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), from, count * sizeof(T));
    from += count * sizeof(T);
}

XXH128_hash_t checksum(const std::string& key, const std::string& content, std::size_t counts_begin) {
    const std::uint64_t seed = XXH3_64bits(key.data(), key.size());
    XXH3_state_t* state = XXH3_createState();
    XXH3_128bits_reset_withSeed(state, seed);
    XXH3_128bits_update(state, content.data() + counts_begin, 3 * sizeof(std::uint64_t));
    XXH3_128bits_update(state, content.data() + sizeof(Header), content.size() - sizeof(Header));
    const XXH128_hash_t hash = XXH3_128bits_digest(state);
    XXH3_freeState(state);
    return hash;
}

std::string encode(const std::string& key, const TetMesh& mesh) {
    Header header{kMagic, mesh.positions.size(), mesh.tets.size(), mesh.faces.size(), {}};
    std::string content(sizeof(Header), '\0');
    std::memcpy(content.data(), &header, sizeof(Header));
    append(content, mesh.positions);
    append(content, mesh.tets);
    append(content, mesh.faces);

    const XXH128_hash_t hash = checksum(key, content, offsetof(Header, nodes));
    header.checksum[0] = hash.low64;
    header.checksum[1] = hash.high64;
    std::memcpy(content.data(), &header, sizeof(Header));
    return content;
}

/// True if the counts add up to exactly this many bytes; counts so large that the sum would wrap cannot.
bool fits(const Header& header, std::size_t bytes) {
    if (header.nodes > bytes || header.tets > bytes || header.faces > bytes) return false;
    return sizeof(Header) + header.nodes * sizeof(glm::dvec3) + header.tets * sizeof(glm::uvec4) +
               header.faces * sizeof(glm::uvec3) ==
           bytes;
}

std::optional<TetMesh> decode(const std::string& key, const std::string& content) {
    Header header;
    if (content.size() < sizeof(Header)) return std::nullopt;
    std::memcpy(&header, content.data(), sizeof(Header));
    if (header.magic != kMagic || !fits(header, content.size())) return std::nullopt;
    const XXH128_hash_t hash = checksum(key, content, offsetof(Header, nodes));
    if (hash.low64 != header.checksum[0] || hash.high64 != header.checksum[1]) return std::nullopt;

    TetMesh mesh;
    const char* from = content.data() + sizeof(Header);
    take(from, header.nodes, mesh.positions);
    take(from, header.tets, mesh.tets);
    take(from, header.faces, mesh.faces);
    return mesh;
}

fs::path from_environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? fs::path() : fs::path(value);
}

fs::path entry_name(const fs::path& folder, const std::string& key) {
    return folder / (key + ".tets");
}

}  // namespace

fs::path TetCache::default_folder() {
    if (fs::path own = from_environment("GELATIN_CACHE_DIR"); !own.empty()) return own;
    if (fs::path all = from_environment("XDG_CACHE_HOME"); !all.empty()) return all / "gelatin";
    if (fs::path home = from_environment("HOME"); !home.empty()) return home / ".cache" / "gelatin";
    return {};
}

TetCache::TetCache(fs::path folder) : folder_(std::move(folder)) {}

std::optional<TetMesh> TetCache::find(const std::string& key) const {
    const fs::path file = entry_name(folder_, key);
    std::error_code error;
    if (folder_.empty() || !fs::is_regular_file(file, error)) return std::nullopt;
    try {
        return decode(key, read_file(file));
    } catch (const InvalidInput&) {  // unreadable, or gone since: as good as not there
        return std::nullopt;
    }
}

void TetCache::store(const std::string& key, const TetMesh& mesh) const {
    if (folder_.empty()) return;
    // The name an entry is written under is unique to a process, not to its threads.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    try {
        fs::create_directories(folder_);
        write_file(entry_name(folder_, key), encode(key, mesh));
    } catch (const fs::filesystem_error& error) {
        spdlog::warn("tetrahedra are not kept for the next run: {}: {}", folder_.string(),
                     error.code().message());
    } catch (const SystemError& error) {
        spdlog::warn("tetrahedra are not kept for the next run: {}", error.what());
    }
}

}  // namespace gelatin
