#include "render/line_overlay.h"

#include <epoxy/gl.h>

namespace gelatin::render {
namespace {

constexpr float kHiddenLine = 0.7f;  // opacity of hidden parts: most points are inside bodies

}  // namespace

LineOverlay::LineOverlay()
    : program_(gl::Program::graphics("render/marked_lines.vert", "render/marked_lines.frag")) {}

// All of them fainter, then the visible parts over them.
void LineOverlay::draw(const Frame& frame, const OverlayView& overlay) const {
    const gl::BufferTexture lines(overlay.lines, std::size_t{32} * overlay.line_count,
                                  gl::TexelFormat::rgba32f);
    program_.bind("marked_lines", lines);
    frame.view.set_uniforms(program_);
    program_.set("cut_plane", frame.bodies.surfaces.cut_plane());
    program_.set("line_scale", frame.view.line_scale());
    glEnable(GL_POLYGON_OFFSET_FILL);  // points lie in surfaces
    glPolygonOffset(-1.0f, -16.0f);
    for (const bool in_front : {false, true}) {
        (in_front ? glEnable : glDisable)(GL_DEPTH_TEST);
        program_.set("opacity", in_front ? 1.0f : kHiddenLine);
        program_.draw_arrays(gl::Primitive::triangles, std::size_t{6} * overlay.line_count);
    }
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace gelatin::render
