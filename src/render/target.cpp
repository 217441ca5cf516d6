#include "render/target.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

#include "gelatin/error.h"
#include "gl/object_name.h"

namespace gelatin::render {

PixelRect PixelRect::joined(const PixelRect& other) const {
    if (is_empty()) return other;
    if (other.is_empty()) return *this;
    return {std::min(left, other.left), std::min(bottom, other.bottom), std::max(right, other.right),
            std::max(top, other.top)};
}

Target Target::multisampled(int width, int height, int samples) {
    const FramebufferGuard guard;
    Target target(width, height);
    glGenFramebuffers(1, &target.framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer_);
    glGenRenderbuffers(2, target.renderbuffers_);
    const GLenum formats[] = {GL_RGBA8, GL_DEPTH_COMPONENT24};
    const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    for (int i = 0; i < 2; ++i) {
        glBindRenderbuffer(GL_RENDERBUFFER, target.renderbuffers_[i]);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, formats[i], width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachments[i], GL_RENDERBUFFER, target.renderbuffers_[i]);
    }
    target.check_complete();
    return target;
}

Target Target::color(int width, int height, unsigned internal_format) {
    const FramebufferGuard guard;
    Target target(width, height);
    target.attach_texture(internal_format, GL_COLOR_ATTACHMENT0);
    target.check_complete();
    return target;
}

Target Target::color_and_depth(int width, int height) {
    const FramebufferGuard guard;
    Target target = color(width, height, GL_RGBA8);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer_);
    glGenRenderbuffers(1, target.renderbuffers_);
    glBindRenderbuffer(GL_RENDERBUFFER, target.renderbuffers_[0]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target.renderbuffers_[0]);
    target.check_complete();
    return target;
}

Target Target::depth(int width, int height, unsigned internal_format) {
    const FramebufferGuard guard;
    Target target(width, height);
    target.attach_texture(internal_format, GL_DEPTH_ATTACHMENT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    target.check_complete();
    return target;
}

void Target::attach_texture(unsigned internal_format, unsigned attachment) {
    glGenTextures(1, &texture_);
    gl::forget_state();  // a unit's binding changes
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexStorage2D(GL_TEXTURE_2D, 1, internal_format, width_, height_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture_, 0);
}

void Target::check_complete() const {
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    throw GlError("the driver cannot draw into a picture of " + std::to_string(width_) + " x " +
                  std::to_string(height_) + " pixels");
}

Target& Target::operator=(Target&& other) noexcept {
    Target old(std::move(*this));
    swap(other);
    return *this;
}

void Target::swap(Target& other) noexcept {
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(framebuffer_, other.framebuffer_);
    std::swap(texture_, other.texture_);
    std::swap(renderbuffers_, other.renderbuffers_);
}

Target::~Target() {
    if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
    if (texture_ != 0) {
        glDeleteTextures(1, &texture_);
        gl::forget_state();
    }
    if (renderbuffers_[0] != 0) glDeleteRenderbuffers(2, renderbuffers_);
}

void Target::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, width_, height_);
}

void Target::copy_color_to(const Target& target) const {
    copy_to(target, pixels(), GL_COLOR_BUFFER_BIT);
}

void Target::copy_color_to(const Target& target, const PixelRect& pixels) const {
    copy_to(target, pixels, GL_COLOR_BUFFER_BIT);
}

void Target::copy_depth_to(const Target& target, const PixelRect& pixels) const {
    copy_to(target, pixels, GL_DEPTH_BUFFER_BIT);
}

void Target::copy_to(const Target& target, const PixelRect& pixels, unsigned what) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer_);
    const auto [left, bottom, right, top] = pixels;
    if (!pixels.is_empty())
        glBlitFramebuffer(left, bottom, right, top, left, bottom, right, top, what, GL_NEAREST);
}

}  // namespace gelatin::render
