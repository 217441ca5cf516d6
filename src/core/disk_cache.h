#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gelatin {

/// Bytes kept on disk by a key of everything they depend on. Several processes may share it: entries appear
/// by rename, whole or not at all; a damaged entry is a miss. A folder that cannot be written is a warning,
/// not an error.
class DiskCache {
public:
    /// GELATIN_CACHE_DIR, else XDG_CACHE_HOME/gelatin, else ~/.cache/gelatin.
    static std::filesystem::path default_folder();

    /// @param folder made where it is first written to; empty: nothing is kept
    /// @param what the entries are, for the warning, and the ending of their names: "tets"
    DiskCache(std::filesystem::path folder, std::string what);

    std::optional<std::string> find(const std::string& key) const;
    void store(const std::string& key, const std::string& content) const;

private:
    std::filesystem::path entry(const std::string& key) const;

    std::filesystem::path folder_;
    std::string what_;
};

}  // namespace gelatin
