#include "render/arrow_overlay.h"

#include <epoxy/gl.h>

namespace gelatin::render {

ArrowOverlay::ArrowOverlay() : program_(gl::Program::graphics("render/arrows.vert", "render/arrows.frag")) {}

void ArrowOverlay::draw_velocities(const Frame& frame, const RenderView& bodies) const {
    draw(frame, bodies, *bodies.overlay.arrows, {{0.05f, 0.07f, 0.20f}, 0.0f, 0.15f});
}

void ArrowOverlay::draw_forces(const Frame& frame, const RenderView& bodies) const {
    draw(frame, bodies, *bodies.overlay.contact_forces, {{0.55f, 0.02f, 0.05f}, 0.9f, 0.6f});
}

// All of them faintly, then the visible parts over them.
void ArrowOverlay::draw(const Frame& frame, const RenderView& bodies, const ArrowView& arrows,
                        const Style& style) const {
    const std::size_t node_bytes = std::size_t{16} * bodies.overlay.node_count;
    const gl::BufferTexture positions(bodies.overlay.node_positions, node_bytes, gl::TexelFormat::rgba32f);
    const gl::BufferTexture vectors(arrows.vectors, node_bytes, gl::TexelFormat::rgba32f);
    const gl::BufferTexture nodes(arrows.nodes, std::size_t{4} * arrows.count, gl::TexelFormat::r32ui);
    program_.bind("node_positions", positions);
    program_.bind("vectors", vectors);
    program_.bind("arrow_nodes", nodes);
    frame.view.set_uniforms(program_);
    program_.set("cut_plane", frame.bodies.surfaces.cut_plane());
    program_.set("arrow_scale", arrows.scale);
    program_.set("ink", style.ink);
    program_.set("dot_radius", style.dot);
    program_.set("line_scale", frame.view.line_scale());
    glEnable(GL_POLYGON_OFFSET_FILL);  // they begin in the surface
    glPolygonOffset(-1.0f, -16.0f);
    for (const bool in_front : {false, true}) {
        (in_front ? glEnable : glDisable)(GL_DEPTH_TEST);
        program_.set("opacity", in_front ? 1.0f : style.hidden);
        program_.draw_arrays(gl::Primitive::triangles, std::size_t{6} * arrows.count);
    }
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace gelatin::render
