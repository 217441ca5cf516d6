#include "render/frame_grabber.h"

#include <epoxy/gl.h>

#include <utility>

#include "gelatin/error.h"
#include "render/target.h"

namespace gelatin::render {
namespace {

// OpenGL's rows are ordered from the bottom, a picture's from the top; drivers copy four components faster
// than three.
Image to_image(const std::uint8_t* rgba, int width, int height) {
    Image image(width, height);
    const std::size_t columns = static_cast<std::size_t>(width);
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* from = rgba + 4 * columns * static_cast<std::size_t>(height - 1 - y);
        std::uint8_t* to = image.at(0, y);
        for (std::size_t x = 0; x < columns; ++x) {
            to[3 * x] = from[4 * x];
            to[3 * x + 1] = from[4 * x + 1];
            to[3 * x + 2] = from[4 * x + 2];
        }
    }
    return image;
}

}  // namespace

FrameGrabber::FrameGrabber(int width, int height) : width_(width), height_(height) {
    const GLsizeiptr bytes = GLsizeiptr{4} * width * height;
    glGenBuffers(2, buffers_.data());
    for (const unsigned buffer : buffers_) {
        glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
        glBufferData(GL_PIXEL_PACK_BUFFER, bytes, nullptr, GL_STREAM_READ);
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

FrameGrabber::~FrameGrabber() {
    glDeleteBuffers(2, buffers_.data());
}

std::optional<Image> FrameGrabber::grab(unsigned framebuffer) {
    const unsigned previous = buffers_[newest_];
    newest_ = 1 - newest_;
    const FramebufferGuard guard;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffers_[newest_]);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    if (!std::exchange(under_way_, true)) return {};
    return read(previous);
}

std::optional<Image> FrameGrabber::flush() {
    if (!std::exchange(under_way_, false)) return {};
    return read(buffers_[newest_]);
}

Image FrameGrabber::read(unsigned buffer) const {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
    const void* mapped =
        glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0, GLsizeiptr{4} * width_ * height_, GL_MAP_READ_BIT);
    if (mapped == nullptr) throw GlError("a picture cannot be copied to the host");
    Image image = to_image(static_cast<const std::uint8_t*>(mapped), width_, height_);
    glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    return image;
}

}  // namespace gelatin::render
