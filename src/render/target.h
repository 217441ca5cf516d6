#pragma once

#include <utility>

#include "gl/draw_state.h"

namespace gelatin::render {

using gl::FramebufferGuard;

/// Pixels of a picture: columns [left, right), rows [bottom, top).
struct PixelRect {
    int left = 0, bottom = 0, right = 0, top = 0;

    bool is_empty() const { return right <= left || top <= bottom; }
    /// The smallest area that contains both.
    PixelRect joined(const PixelRect& other) const;
    bool operator==(const PixelRect&) const = default;
};

/// A framebuffer to draw into, with its attachments. Move-only. Creating one does not change the bound
/// framebuffers.
class Target {
public:
    Target() = default;
    /// Colour (RGBA8) and depth with `samples` in each pixel, for drawing and resolving only.
    /// @throws GlError if the driver cannot create it; the same for the others.
    static Target multisampled(int width, int height, int samples);
    /// A colour texture, sampled linearly, clamped at its edge.
    /// @param internal_format for example GL_RGBA8
    static Target color(int width, int height, unsigned internal_format);
    /// A colour texture (RGBA8) with depth.
    static Target color_and_depth(int width, int height);
    /// A depth texture, read without filtering.
    static Target depth(int width, int height, unsigned internal_format);
    Target(Target&& other) noexcept { swap(other); }
    Target& operator=(Target&& other) noexcept;
    ~Target();

    int width() const { return width_; }
    int height() const { return height_; }
    unsigned framebuffer() const { return framebuffer_; }
    unsigned texture() const { return texture_; }

    /// Directs later draws here, with the viewport over all of it.
    void bind() const;

    /// Copies to a target of the same size; several samples of a pixel are averaged. Later draws go there.
    void copy_color_to(const Target& target) const;
    /// Copies pixels to the same position in another target. @pre both are color_and_depth
    void copy_color_to(const Target& target, const PixelRect& pixels) const;
    void copy_depth_to(const Target& target, const PixelRect& pixels) const;
    /// All pixels.
    PixelRect pixels() const { return {0, 0, width_, height_}; }

private:
    Target(int width, int height) : width_(width), height_(height) {}
    void swap(Target& other) noexcept;
    void attach_texture(unsigned internal_format, unsigned attachment);
    void check_complete() const;
    void copy_to(const Target& target, const PixelRect& pixels, unsigned what) const;

    int width_ = 0;
    int height_ = 0;
    unsigned framebuffer_ = 0;
    unsigned texture_ = 0;
    unsigned renderbuffers_[2] = {0, 0};
};

}  // namespace gelatin::render
