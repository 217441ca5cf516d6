#include "render/arrow_overlay.h"

#include <epoxy/gl.h>

namespace gelatin::render {
namespace {

constexpr float kHidden = 0.15f;  // opacity of what lies behind something

}  // namespace

ArrowOverlay::ArrowOverlay() : program_(gl::Program::graphics("render/arrows.vert", "render/arrows.frag")) {}

// All of them faintly, then over that what is in front.
void ArrowOverlay::draw(const Frame& frame, const RenderView& bodies) const {
    const ArrowView& arrows = *bodies.overlay.arrows;
    const std::size_t node_bytes = std::size_t{16} * bodies.node_count;
    const gl::BufferTexture positions(bodies.node_positions, node_bytes, gl::TexelFormat::rgba32f);
    const gl::BufferTexture velocities(arrows.velocities, node_bytes, gl::TexelFormat::rgba32f);
    const gl::BufferTexture nodes(arrows.nodes, std::size_t{4} * arrows.count, gl::TexelFormat::r32ui);
    program_.bind("node_positions", positions);
    program_.bind("velocities", velocities);
    program_.bind("arrow_nodes", nodes);
    frame.view.set_uniforms(program_);
    program_.set("cut_plane", frame.bodies.surfaces.cut_plane());
    program_.set("arrow_time", arrows.time);
    program_.set("line_scale", frame.view.line_scale());
    glEnable(GL_POLYGON_OFFSET_FILL);  // they begin in the surface
    glPolygonOffset(-1.0f, -16.0f);
    for (const bool in_front : {false, true}) {
        (in_front ? glEnable : glDisable)(GL_DEPTH_TEST);
        program_.set("opacity", in_front ? 1.0f : kHidden);
        program_.draw_arrays(gl::Primitive::triangles, std::size_t{6} * arrows.count);
    }
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace gelatin::render
