#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gelatin {

/// Returns the whole content of a file.
/// @throws InvalidInput if it is missing, a folder, or cannot be read.
std::string read_file(const std::filesystem::path& file);

/// Writes a regular file completely or not at all: under a temporary name in the same folder, flushed to
/// disk, then renamed. For a symbolic link, the same with the file that it links to; the link stays. A file
/// that is_stream is written through.
/// @throws SystemError with the system's reason (no such folder, disk full, ...); nothing is left behind.
void write_file(const std::filesystem::path& file, const std::string& content);

/// True for what is written through and never replaced: "-", which is standard output, open descriptors
/// (/dev/stdout), devices and pipes.
bool is_stream(const std::filesystem::path& file);

/// True for "-", /dev/stdout and other names of the same.
bool is_standard_output(const std::filesystem::path& file);

/// The end of a chain of symbolic links, which need not exist; `file` itself if it is no link.
/// @throws SystemError if the chain has no end
std::filesystem::path link_target(const std::filesystem::path& file);

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
