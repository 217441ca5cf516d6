#include "render/vertex_light.h"

namespace gelatin::render {

VertexLight::VertexLight()
    : light_program_(gl::Program::compute("render/light_vertices.comp")),
      draw_program_(gl::Program::graphics("render/lit_surface.vert", "render/lit_surface.frag")) {}

void VertexLight::light(const Frame& frame, const Layer& layer) {
    const std::uint32_t vertex_count = layer.surfaces.vertex_count();
    if (clip_positions_.size() != vertex_count) {
        clip_positions_ = gl::Buffer<glm::vec4>(vertex_count);
        display_colors_ = gl::Buffer<std::uint32_t>(vertex_count);
    }
    frame.view.set_uniforms(light_program_);
    frame.shadows.set_uniforms(light_program_);
    light_program_.set("jelly", layer.jelly);
    light_program_.set("vertex_count", vertex_count);
    frame.shadows.bind_textures(light_program_);
    layer.surfaces.bind(light_program_);
    light_program_.bind("object_colors", layer.colors);
    light_program_.bind("ClipPositions", clip_positions_);
    light_program_.bind("DisplayColors", display_colors_);
    light_program_.dispatch(vertex_count);
    gl::barrier(gl::Barrier::vertex_pull | gl::Barrier::storage);
}

void VertexLight::draw(const Layer& layer) const {
    draw_program_.bind_input("clip_position", clip_positions_);
    draw_program_.bind_input("display_color", display_colors_);
    layer.surfaces.draw_triangles(draw_program_);
}

}  // namespace gelatin::render
