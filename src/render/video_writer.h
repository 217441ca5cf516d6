#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/file.h"
#include "core/process.h"
#include "render/image.h"

namespace gelatin::render {

/// Frames per second, as a fraction.
struct FrameRate {
    int numerator = 60;
    int denominator = 1;

    /// The nearest fraction of thousandths. @throws InvalidInput unless 0.001 <= rate <= 1,000,000
    static FrameRate from(double rate);
};

/// Writes a film (H.264, 4:2:0, BT.709) by sending frames to the program ffmpeg. The film appears under its
/// name when `finish` has returned; without `finish`, the destructor leaves nothing behind.
class VideoWriter {
public:
    /// @param file ends in .mp4, .mov or .mkv
    /// @param width, height of all frames [pixels]; if one is odd the film is a pixel larger, and the last
    ///   pixel is repeated
    /// @throws InvalidInput for another extension; SystemError if there is no ffmpeg.
    VideoWriter(std::filesystem::path file, int width, int height, FrameRate rate);
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;
    ~VideoWriter();

    /// @throws SystemError with ffmpeg's last message if it has ended (disk full, no such folder, ...).
    void write(const Image& frame);

    /// Ends the film. @throws SystemError as `write`; InvalidInput if there was no frame.
    void finish();

private:
    [[noreturn]] void fail(const std::string& reason);
    void discard();

    std::filesystem::path file_;
    std::optional<TemporaryFolder> folder_;  // of a film that goes into a pipe or device: mp4 needs to seek
    std::filesystem::path partial_;
    int width_;  // of the film
    int height_;
    std::size_t frames_ = 0;
    std::vector<std::uint8_t> padded_;
    std::unique_ptr<FedProcess> encoder_;
};

}  // namespace gelatin::render
