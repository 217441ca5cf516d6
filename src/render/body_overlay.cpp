#include "render/body_overlay.h"

#include "render/legend.h"

namespace gelatin::render {

void BodyOverlay::prepare(const OverlayView& overlay) {
    if (overlay.color_map) {
        if (!colored_program_)
            colored_program_ =
                gl::Program::graphics("render/colored_surface.vert", "render/colored_surface.frag");
    } else if (!cut_light_) {
        cut_light_.emplace(nullptr, gl::Defines{"CUT"});
    }
}

void BodyOverlay::draw(const Frame& frame, const RenderView& bodies) const {
    const Clipping clipping(frame.bodies.surfaces);
    if (bodies.overlay.color_map) return draw_colored(frame, bodies);
    cut_light_->program().set("cut_plane", frame.bodies.surfaces.cut_plane());
    cut_light_->draw(frame, {&frame.bodies});
}

void BodyOverlay::draw_colored(const Frame& frame, const RenderView& bodies) const {
    const ColorMapView& map = *bodies.overlay.color_map;
    const gl::BufferTexture values(map.node_values, std::size_t{4} * bodies.node_count,
                                   gl::TexelFormat::r32f);
    colored_program_->bind("node_values", values);
    set_value_colors(*colored_program_, map);
    frame.view.set_uniforms(*colored_program_);
    colored_program_->set("cut_plane", frame.bodies.surfaces.cut_plane());
    frame.bodies.surfaces.draw(*colored_program_);
}

}  // namespace gelatin::render
