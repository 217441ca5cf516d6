#pragma once

#include <filesystem>
#include <optional>

#include "render/frame_grabber.h"
#include "render/video_writer.h"

namespace gelatin::viewer {

/// A film of the picture without the panels. It uses simulated time, so a computer that is too slow for real
/// time does not affect it.
class Film {
public:
    /// @param width, height of all pictures [pixels]
    /// @throws SystemError if there is no ffmpeg
    Film(const std::filesystem::path& file, int width, int height);

    const std::filesystem::path& file() const { return file_; }
    int width() const { return width_; }
    int height() const { return height_; }

    /// Adds the picture at simulated time `time` [s]. It is written if it follows the previous one by a
    /// sixtieth of a second at `speed`, as often as that fits. After a step back in time the film continues
    /// from there.
    /// @throws SystemError if the film cannot be written
    void add(unsigned framebuffer, double time, double speed);

    /// Ends the film; without pictures there is none. @throws SystemError
    void finish();

private:
    void write(const std::optional<render::Image>& picture);

    std::filesystem::path file_;
    int width_, height_;
    render::FrameGrabber grabber_;
    render::VideoWriter writer_;
    std::optional<double> next_;  // when the next picture is due [s]
    int repeats_ = 0;             // of the picture that the grabber still holds
    bool is_empty_ = true;
};

}  // namespace gelatin::viewer
