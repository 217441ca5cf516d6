#include "render/attachment_overlay.h"

#include <epoxy/gl.h>

namespace gelatin::render {
namespace {

constexpr float kHiddenAttachment = 0.7f;  // opacity of hidden parts: most points are inside bodies

}  // namespace

AttachmentOverlay::AttachmentOverlay()
    : program_(gl::Program::graphics("render/attachments.vert", "render/attachments.frag")) {}

// All of them fainter, then the visible parts over them.
void AttachmentOverlay::draw(const Frame& frame, const OverlayView& overlay) const {
    const gl::BufferTexture lines(overlay.attachment_lines, std::size_t{32} * overlay.attachment_line_count,
                                  gl::TexelFormat::rgba32f);
    program_.bind("attachment_lines", lines);
    frame.view.set_uniforms(program_);
    program_.set("cut_plane", frame.bodies.surfaces.cut_plane());
    program_.set("line_scale", frame.view.line_scale());
    glEnable(GL_POLYGON_OFFSET_FILL);  // points lie in surfaces
    glPolygonOffset(-1.0f, -16.0f);
    for (const bool in_front : {false, true}) {
        (in_front ? glEnable : glDisable)(GL_DEPTH_TEST);
        program_.set("opacity", in_front ? 1.0f : kHiddenAttachment);
        program_.draw_arrays(gl::Primitive::triangles, std::size_t{6} * overlay.attachment_line_count);
    }
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace gelatin::render
