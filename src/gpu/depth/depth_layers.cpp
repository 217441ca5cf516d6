#include "gpu/depth/depth_layers.h"

#include <epoxy/gl.h>

#include <string>

#include "gelatin/error.h"
#include "gl/draw_state.h"

namespace gelatin::gpu {
namespace {

constexpr GLfloat kFarthest = 1.0f;
constexpr GLuint kNobody = 0xFFFFFFFFu;

void check_complete(int resolution) {
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    throw GlError("the driver cannot draw into pictures of depths and objects of " +
                  std::to_string(resolution) + " pixels a side");
}

}  // namespace

// Made empty first, so that what follows may throw.
DepthLayers::DepthLayers(int resolution) : DepthLayers() {
    make_textures(resolution);
    make_framebuffers(resolution);
}

void DepthLayers::make_textures(int resolution) {
    constexpr GLenum kFormats[picture_count] = {GL_DEPTH_COMPONENT32F, GL_R32UI, GL_DEPTH_COMPONENT32F};
    glGenTextures(picture_count, textures_);
    gl::forget_state();  // a unit's binding changes
    for (unsigned picture = 0; picture < picture_count; ++picture) {
        glBindTexture(GL_TEXTURE_2D, textures_[picture]);
        glTexStorage2D(GL_TEXTURE_2D, 1, kFormats[picture], resolution, resolution);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
}

void DepthLayers::make_framebuffers(int resolution) {
    const gl::FramebufferGuard guard;
    const auto attach = [&](GLenum attachment, Picture picture) {
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, textures_[picture], 0);
    };
    const auto draw_no_color = [] {
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    };
    glGenFramebuffers(pass_count, framebuffers_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[nearest]);
    attach(GL_DEPTH_ATTACHMENT, nearest_depth);
    attach(GL_COLOR_ATTACHMENT0, nearest_object);
    check_complete(resolution);

    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[nearest_other]);
    attach(GL_DEPTH_ATTACHMENT, nearest_other_depth);
    draw_no_color();
    check_complete(resolution);

    // No pictures: the textures are read then.
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[comparison]);
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, resolution);
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, resolution);
    draw_no_color();
    check_complete(resolution);
}

DepthLayers::~DepthLayers() {
    glDeleteFramebuffers(pass_count, framebuffers_);  // silent for 0
    glDeleteTextures(picture_count, textures_);
    gl::forget_state();
}

void DepthLayers::begin_nearest() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[nearest]);
    glClearBufferfv(GL_DEPTH, 0, &kFarthest);
    glClearBufferuiv(GL_COLOR, 0, &kNobody);
}

void DepthLayers::begin_nearest_other() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[nearest_other]);
    glClearBufferfv(GL_DEPTH, 0, &kFarthest);
}

void DepthLayers::begin_comparison() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[comparison]);
}

void DepthLayers::bind_nearest_object(const gl::Program& program) const {
    program.bind_texture("nearest_object", textures_[nearest_object]);
}

void DepthLayers::bind_all(const gl::Program& program) const {
    bind_nearest_object(program);
    program.bind_texture("nearest_depth", textures_[nearest_depth]);
    program.bind_texture("nearest_other_depth", textures_[nearest_other_depth]);
}

}  // namespace gelatin::gpu
