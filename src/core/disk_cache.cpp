#include "core/disk_cache.h"

#include <fmt/core.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <type_traits>
#include <utility>

#include "core/content_hash.h"
#include "core/file.h"
#include "core/log.h"
#include "gelatin/error.h"

namespace gelatin {
namespace fs = std::filesystem;

namespace {

/// An entry is this header, followed by the content. The cache belongs to one machine, so its byte order is
/// the machine's; on another the magic number does not match.
struct Header {
    std::uint64_t magic;
    std::uint64_t bytes;        // of the content
    std::uint64_t checksum[2];  // of the key and the content: a renamed entry counts as damaged
};
constexpr std::uint64_t kMagic = 0x3248'4341'434c'4701;  // "GLCACH2" and the format's version
static_assert(sizeof(Header) == 32 && std::is_trivially_copyable_v<Header>);

Header make_header(const std::string& key, const char* content, std::size_t bytes) {
    ContentHash hash;
    hash.add(key);
    hash.add(content, bytes);
    return {kMagic, bytes, {hash.low(), hash.high()}};
}

fs::path from_environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? fs::path() : fs::path(value);
}

}  // namespace

fs::path DiskCache::default_folder() {
    if (fs::path own = from_environment("GELATIN_CACHE_DIR"); !own.empty()) return own;
    if (fs::path all = from_environment("XDG_CACHE_HOME"); !all.empty()) return all / "gelatin";
    if (fs::path home = from_environment("HOME"); !home.empty()) return home / ".cache" / "gelatin";
    return {};
}

DiskCache::DiskCache(fs::path folder, std::string what)
    : folder_(std::move(folder)), what_(std::move(what)) {}

std::optional<std::string> DiskCache::find(const std::string& key) const {
    const fs::path file = entry(key);
    std::error_code error;
    if (folder_.empty() || !fs::is_regular_file(file, error)) return std::nullopt;
    try {
        std::string content = read_file(file);
        Header header;
        if (content.size() < sizeof(Header)) return std::nullopt;
        std::memcpy(&header, content.data(), sizeof(Header));
        const Header right =
            make_header(key, content.data() + sizeof(Header), content.size() - sizeof(Header));
        if (std::memcmp(&header, &right, sizeof(Header)) != 0) return std::nullopt;
        content.erase(0, sizeof(Header));
        return content;
    } catch (const InvalidInput&) {  // unreadable, or removed meanwhile: a miss
        return std::nullopt;
    }
}

void DiskCache::store(const std::string& key, const std::string& content) const {
    if (folder_.empty()) return;
    const Header header = make_header(key, content.data(), content.size());
    std::string whole(sizeof(Header), '\0');
    std::memcpy(whole.data(), &header, sizeof(Header));
    whole += content;
    // The temporary name of an entry is unique to a process, but not to its threads.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    try {
        fs::create_directories(folder_);
        write_file(entry(key), whole);
    } catch (const fs::filesystem_error& error) {
        log_warning(fmt::format("{} cannot be cached for the next run: {}: {}", what_, folder_.string(),
                                error.code().message()));
    } catch (const SystemError& error) {
        log_warning(fmt::format("{} cannot be cached for the next run: {}", what_, error.what()));
    }
}

fs::path DiskCache::entry(const std::string& key) const {
    return folder_ / (key + "." + what_);
}

}  // namespace gelatin
