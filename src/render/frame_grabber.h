#pragma once

#include <array>
#include <optional>

#include "render/image.h"

namespace gelatin::render {

/// Reads pictures back without stalling: while one frame is copied, the next is drawn.
class FrameGrabber {
public:
    /// @param width, height of all frames [pixels]
    FrameGrabber(int width, int height);
    FrameGrabber(const FrameGrabber&) = delete;
    FrameGrabber& operator=(const FrameGrabber&) = delete;
    ~FrameGrabber();

    /// Starts the copy of a framebuffer's colour and returns the picture of the previous call, if there was
    /// one.
    std::optional<Image> grab(unsigned framebuffer);

    /// The last pending picture, if there is one; waits for it.
    std::optional<Image> flush();

private:
    Image read(unsigned buffer) const;

    int width_;
    int height_;
    std::array<unsigned, 2> buffers_{};
    std::size_t newest_ = 0;  // of buffers_
    bool under_way_ = false;
};

}  // namespace gelatin::render
