#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/recording/recorded_meshes.h"

namespace gelatin {

/// What a recording is of.
struct RecordingHead {
    RecordedScene scene;
    std::uint64_t topology = 0;  ///< topology_hash of its model
};

/// A frame in the file.
struct RecordingEntry {
    std::int32_t frame = 0;
    bool is_key = false;                 ///< it is not predicted from the one before
    double time = 0.0;                   ///< [s]
    std::uint64_t offset = 0, size = 0;  ///< of its bytes in the file
    std::uint64_t checksum = 0;          ///< of its bytes
};

/// Bytes in a file: a head, then frames one after the other, each with a checksum. Whatever the file ends
/// with, all frames before are whole.
class RecordingOutput {
public:
    /// @throws SystemError
    RecordingOutput(std::filesystem::path file, const RecordingHead& head);

    /// Appends a frame, of which offset, size and checksum are ignored. @throws SystemError
    void append(RecordingEntry entry, const std::string& bytes);

private:
    void write(const std::string& bytes);

    std::filesystem::path file_;
    std::ofstream stream_;
};

class RecordingInput {
public:
    /// @throws InvalidInput if it cannot be read or is no recording
    explicit RecordingInput(std::filesystem::path file);

    const std::filesystem::path& file() const { return file_; }
    const RecordingHead& head() const { return head_; }
    const std::vector<RecordingEntry>& entries() const { return entries_; }
    bool is_cut_off() const { return is_cut_off_; }

    /// @throws InvalidInput if they are not what was written
    std::string read(const RecordingEntry& entry) const;

private:
    void take_head(const std::string& text);
    void find_entries(std::uint64_t offset);
    [[noreturn]] void refuse(const std::string& problem) const;

    std::filesystem::path file_;
    mutable std::ifstream stream_;
    RecordingHead head_;
    std::vector<RecordingEntry> entries_;
    bool is_cut_off_ = false;
};

}  // namespace gelatin
