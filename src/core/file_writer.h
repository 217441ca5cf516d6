#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gelatin {

/// Writes a file piece by piece, under a temporary name until it is finished, with what write_file promises.
/// What is not finished is removed.
class FileWriter {
public:
    /// @throws SystemError with the system's reason, as all others do
    explicit FileWriter(std::filesystem::path file);
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;
    ~FileWriter();

    void append(std::string_view bytes);
    void finish();

private:
    void flush();
    void discard();
    [[noreturn]] void fail(int reason);

    std::filesystem::path file_, target_, partial_;  // partial_ is empty for what is written through
    int descriptor_ = -1;
    std::string buffer_;
};

/// Bytes that are kept in a file without a name: nothing is left of it, however this process ends.
class ScratchFile {
public:
    /// @param folder in which there is room for it @throws SystemError, as all others do
    explicit ScratchFile(std::filesystem::path folder);
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile();

    void append(const void* data, std::size_t size);
    std::size_t size() const { return size_; }
    /// @pre they are there
    void read(std::size_t offset, void* data, std::size_t size) const;

private:
    std::filesystem::path folder_;
    int descriptor_ = -1;
    std::size_t size_ = 0;
};

/// A new descriptor of a file that is_stream; negative, with errno, where it cannot be opened.
int open_stream(const std::filesystem::path& file);

/// @throws SystemError with the system's reason
[[noreturn]] void fail_to_write(const std::filesystem::path& file, int reason);

/// Where a ScratchFile for a file that will be written is best: beside it, if it is a regular one.
std::filesystem::path scratch_folder(const std::filesystem::path& file);

}  // namespace gelatin
