#include "render/vertex_light.h"

#include <epoxy/gl.h>

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
    layer.surfaces.bind_textures();
    layer.colors.bind(3);
    clip_positions_.bind_storage(0);
    display_colors_.bind_storage(1);
    light_program_.dispatch(vertex_count);
    gl::barrier(gl::Barrier::vertex_pull);
}

void VertexLight::draw(const Layer& layer) const {
    glBindBuffer(GL_ARRAY_BUFFER, clip_positions_.id());
    glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
    glBindBuffer(GL_ARRAY_BUFFER, display_colors_.id());
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    draw_program_.use();
    layer.surfaces.draw_triangles();
    glDisableVertexAttribArray(0);
    glDisableVertexAttribArray(1);
}

}  // namespace gelatin::render
