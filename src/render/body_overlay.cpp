#include "render/body_overlay.h"

#include <epoxy/gl.h>

#include "render/legend.h"

namespace gelatin::render {

void BodyOverlay::prepare(const OverlayView& overlay) {
    if (overlay.color_map) {
        if (!colored_program_)
            colored_program_ =
                gl::Program::graphics("render/colored_surface.vert", "render/colored_surface.frag");
        if (!pressed_program_ && overlay.color_map->quantity == Quantity::pressure)
            pressed_program_ =
                gl::Program::graphics("render/colored_surface.vert", "render/pressed_surface.frag");
    } else if (!cut_light_) {
        cut_light_.emplace(nullptr, true);
    }
}

void BodyOverlay::draw(const Frame& frame, const RenderView& bodies) const {
    const Clipping clipping(frame.bodies.surfaces);
    if (frame.bodies.surfaces.is_cut()) glDisable(GL_CULL_FACE);  // what has no tets is hollow
    if (bodies.overlay.color_map) {
        draw_colored(frame, bodies, *colored_program_);
    } else {
        cut_light_->draw(frame, {&frame.bodies});
    }
    glEnable(GL_CULL_FACE);
}

void BodyOverlay::draw_pressed(const Frame& frame, const RenderView& bodies) const {
    const Clipping clipping(frame.bodies.surfaces);
    glDisable(GL_DEPTH_TEST);
    draw_colored(frame, bodies, *pressed_program_);
    glEnable(GL_DEPTH_TEST);
}

void BodyOverlay::draw_colored(const Frame& frame, const RenderView& bodies,
                               const gl::Program& program) const {
    const ColorMapView& map = *bodies.overlay.color_map;
    const gl::BufferTexture values(map.node_values, std::size_t{4} * bodies.node_count,
                                   gl::TexelFormat::r32f);
    program.bind("node_values", values);
    set_value_colors(program, map);
    frame.view.set_uniforms(program);
    program.set("cut_plane", frame.bodies.surfaces.cut_plane());
    frame.bodies.surfaces.draw(program);
}

}  // namespace gelatin::render
