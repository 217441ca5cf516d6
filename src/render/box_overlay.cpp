#include "render/box_overlay.h"

#include <epoxy/gl.h>

namespace gelatin::render {
namespace {

constexpr float kWidth = 1.5f;    // of lines [pixels]
constexpr float kHidden = 0.28f;  // opacity of what lies behind something

}  // namespace

BoxOverlay::BoxOverlay() : program_(gl::Program::graphics("render/box_lines.vert", "render/line.frag")) {}

// All of them faintly, then over that what is in front.
void BoxOverlay::draw(const View& view, const OverlayView& overlay) const {
    const gl::BufferTexture boxes(overlay.boxes, std::size_t{32} * overlay.box_count,
                                  gl::TexelFormat::rgba32f);
    const gl::BufferTexture shown(overlay.shown_boxes, std::size_t{8} * overlay.shown_box_count,
                                  gl::TexelFormat::rg32ui);
    program_.bind("boxes", boxes);
    program_.bind("shown_boxes", shown);
    view.set_uniforms(program_);
    program_.set("line_width", kWidth * view.line_scale());
    for (const bool in_front : {false, true}) {
        (in_front ? glEnable : glDisable)(GL_DEPTH_TEST);
        program_.set("opacity", in_front ? 1.0f : kHidden);
        program_.draw_arrays(gl::Primitive::triangles, std::size_t{72} * overlay.shown_box_count);
    }
    glEnable(GL_DEPTH_TEST);
}

}  // namespace gelatin::render
