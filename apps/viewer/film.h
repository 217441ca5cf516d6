#pragma once

#include <filesystem>
#include <optional>

#include "render/frame_grabber.h"
#include "render/video_writer.h"

namespace gelatin::viewer {

/// A film of the picture without the panels, which goes by simulated time: a computer that is too slow for
/// real time does not show in it.
class Film {
public:
    /// @param width, height of all pictures [pixels]
    /// @throws SystemError if there is no ffmpeg
    Film(const std::filesystem::path& file, int width, int height);

    const std::filesystem::path& file() const { return file_; }
    int width() const { return width_; }
    int height() const { return height_; }

    /// The picture as of simulated time `time` [s], which takes its place in the film where it follows the
    /// one before by a sixtieth of a second at `speed`, or as often as that goes into it. After a step back
    /// in time the film goes on from there.
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
    std::optional<double> next_;  // when a picture is due [s]
    int repeats_ = 0;             // of the picture that the grabber still has
    bool is_empty_ = true;
};

}  // namespace gelatin::viewer
