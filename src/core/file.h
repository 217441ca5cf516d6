#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gelatin {

/// Returns the whole content of a file.
/// @throws InvalidInput if it is missing, a folder, or cannot be read.
std::string read_file(const std::filesystem::path& file);

/// Writes `file` completely or not at all: under a temporary name in the same folder, flushed to disk, then
/// renamed.
/// @throws SystemError with the system's reason (no such folder, disk full, ...); nothing is left behind.
void write_file(const std::filesystem::path& file, const std::string& content);

/// A temporary name in the folder of `file`, unique to this process: ".NAME.PID.partial.EXT".
std::filesystem::path partial_name(const std::filesystem::path& file);

/// A private folder (mode 0700) in the system's temporary one. The destructor removes it with its content.
class TemporaryFolder {
public:
    /// @throws SystemError
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace gelatin
