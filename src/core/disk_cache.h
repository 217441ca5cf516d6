#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gelatin {

/// Bytes stored on disk under a key of everything that they depend on. Several processes may share the cache:
/// an entry appears by a rename, complete or not at all. A damaged entry is a miss. A folder that cannot be
/// written causes a warning, not an error.
class DiskCache {
public:
    /// GELATIN_CACHE_DIR, else XDG_CACHE_HOME/gelatin, else ~/.cache/gelatin.
    static std::filesystem::path default_folder();

    /// @param folder created at the first write; empty: nothing is stored
    /// @param what the kind of entries, for the warning and as their file extension: "tets"
    DiskCache(std::filesystem::path folder, std::string what);

    std::optional<std::string> find(const std::string& key) const;
    void store(const std::string& key, const std::string& content) const;

private:
    std::filesystem::path entry(const std::string& key) const;

    std::filesystem::path folder_;
    std::string what_;
};

}  // namespace gelatin
