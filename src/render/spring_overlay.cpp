#include "render/spring_overlay.h"

#include <epoxy/gl.h>

#include "render/legend.h"

namespace gelatin::render {
namespace {

constexpr float kWidth = 1.2f;  // of lines [pixels]

}  // namespace

SpringOverlay::SpringOverlay()
    : spring_program_(gl::Program::graphics("render/spring_lines.vert", "render/line.frag")),
      glass_program_(gl::Program::graphics("render/surface.vert", "render/glass.frag", {"CUT"})) {}

// Transparent bodies first, through which the springs are then visible.
void SpringOverlay::draw(const Frame& frame, const RenderView& bodies) const {
    const OverlayView& overlay = bodies.overlay;
    frame.view.set_uniforms(glass_program_);
    glass_program_.set("cut_plane", frame.bodies.surfaces.cut_plane());
    glass_program_.bind("object_colors", frame.bodies.colors);
    glEnable(GL_CULL_FACE);
    {
        const Clipping clipping(frame.bodies.surfaces);
        frame.bodies.surfaces.draw(glass_program_);
    }
    glDisable(GL_CULL_FACE);

    const gl::BufferTexture positions(overlay.node_positions, std::size_t{16} * overlay.node_count,
                                      gl::TexelFormat::rgba32f);
    const gl::BufferTexture springs(overlay.springs, std::size_t{16} * overlay.spring_count,
                                    gl::TexelFormat::rgba32ui);
    spring_program_.bind("node_positions", positions);
    spring_program_.bind("springs", springs);
    set_strain_colors(spring_program_, overlay.full_strain);
    frame.view.set_uniforms(spring_program_);
    spring_program_.set("cut_plane", frame.bodies.surfaces.cut_plane());
    spring_program_.set("line_width", kWidth * frame.view.line_scale());
    spring_program_.set("opacity", 1.0f);
    spring_program_.draw_arrays(gl::Primitive::triangles, std::size_t{6} * overlay.spring_count);
}

}  // namespace gelatin::render
