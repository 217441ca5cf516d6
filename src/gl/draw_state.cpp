#include "gl/draw_state.h"

#include <epoxy/gl.h>

#include <iterator>

namespace gelatin::gl {
namespace {

// Each can discard, move or change fragments if an application has enabled it.
constexpr GLenum kSwitches[] = {
    GL_BLEND,          GL_COLOR_LOGIC_OP,      GL_CULL_FACE,      GL_DEPTH_CLAMP,
    GL_DEPTH_TEST,     GL_POLYGON_OFFSET_FILL, GL_POLYGON_SMOOTH, GL_SCISSOR_TEST,
    GL_STENCIL_TEST,   GL_CLIP_DISTANCE0,      GL_CLIP_DISTANCE1, GL_CLIP_DISTANCE2,
    GL_CLIP_DISTANCE3, GL_CLIP_DISTANCE4,      GL_CLIP_DISTANCE5, GL_CLIP_DISTANCE6,
    GL_CLIP_DISTANCE7, GL_RASTERIZER_DISCARD,
};
static_assert(std::size(kSwitches) <= 32);

}  // namespace

FramebufferGuard::FramebufferGuard() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    glGetIntegerv(GL_VIEWPORT, viewport_);
}

FramebufferGuard::~FramebufferGuard() {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
}

DrawStateGuard::DrawStateGuard() {
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
    glGetIntegerv(GL_DRAW_INDIRECT_BUFFER_BINDING, &indirect_buffer_);
    GLint polygon_modes[2] = {};  // some drivers return both sides
    glGetIntegerv(GL_POLYGON_MODE, polygon_modes);
    polygon_mode_ = polygon_modes[0];
    glGetIntegerv(GL_DEPTH_FUNC, &depth_function_);
    glGetDoublev(GL_DEPTH_RANGE, depth_range_);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
    glGetBooleanv(GL_COLOR_WRITEMASK, color_mask_);
    for (std::size_t s = 0; s < std::size(kSwitches); ++s) {
        switches_[s] = glIsEnabled(kSwitches[s]) == GL_TRUE;
        if (switches_[s]) glDisable(kSwitches[s]);
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDepthFunc(GL_LESS);
    glDepthRange(0.0, 1.0);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

DrawStateGuard::~DrawStateGuard() {
    glBindVertexArray(static_cast<GLuint>(vertex_array_));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, static_cast<GLuint>(indirect_buffer_));
    glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(polygon_mode_));
    glDepthFunc(static_cast<GLenum>(depth_function_));
    glDepthRange(depth_range_[0], depth_range_[1]);
    glDepthMask(depth_mask_);
    glColorMask(color_mask_[0], color_mask_[1], color_mask_[2], color_mask_[3]);
    for (std::size_t s = 0; s < std::size(kSwitches); ++s)
        (switches_[s] ? glEnable : glDisable)(kSwitches[s]);
}

}  // namespace gelatin::gl
