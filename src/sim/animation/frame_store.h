#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "core/file_writer.h"

namespace gelatin {

/// Frames of as many floats each, on disk: formats of animations want all frames of an object together, and
/// frames come one after the other.
class FrameStore {
public:
    /// @param file for which they are @param size of a frame @throws SystemError, as all others do
    FrameStore(const std::filesystem::path& file, std::size_t size)
        : size_(size), bytes_(scratch_folder(file)) {}

    /// Appends to the present frame; `size` values make it a whole one.
    void add(std::span<const float> values) { bytes_.append(values.data(), values.size_bytes()); }

    std::size_t frame_count() const { return size_ > 0 ? bytes_.size() / sizeof(float) / size_ : 0; }

    /// Values of a frame, from `first` on.
    std::vector<float> read(std::size_t frame, std::size_t first, std::size_t count) const {
        std::vector<float> values(count);
        bytes_.read((frame * size_ + first) * sizeof(float), values.data(), count * sizeof(float));
        return values;
    }

private:
    std::size_t size_;
    ScratchFile bytes_;
};

}  // namespace gelatin
