#include "render/vertex_light.h"

namespace gelatin::render {

VertexLight::Programs::Programs(const gl::Defines& defines)
    : light(gl::Program::compute("render/light_vertices.comp", defines)),
      draw(gl::Program::graphics("render/lit_surface.vert", "render/lit_surface.frag", defines)) {}

VertexLight::VertexLight() : plain_(gl::Defines()) {}

void VertexLight::light(const Frame& frame, const Layer& layer) {
    const std::uint32_t vertex_count = layer.surfaces.vertex_count();
    if (clip_positions_.size() != vertex_count) {
        clip_positions_ = gl::Buffer<glm::vec4>(vertex_count);
        display_colors_ = gl::Buffer<std::uint32_t>(vertex_count);
    }
    const bool has_textures = layer.surfaces.has_textures();
    if (has_textures && !textured_) textured_.emplace(gl::Defines{"TEXTURED"});
    const gl::Program& program = has_textures ? textured_->light : plain_.light;
    if (has_textures) {
        if (texture_lights_.size() != vertex_count) texture_lights_ = gl::Buffer<glm::vec4>(vertex_count);
        program.bind("TextureLights", texture_lights_);
    }
    frame.view.set_uniforms(program);
    frame.shadows.set_uniforms(program);
    program.set("jelly", layer.jelly);
    program.set("vertex_count", vertex_count);
    frame.shadows.bind_textures(program);
    layer.surfaces.bind(program);
    program.bind("object_colors", layer.colors);
    program.bind("ClipPositions", clip_positions_);
    program.bind("DisplayColors", display_colors_);
    program.dispatch(vertex_count);
    gl::barrier(gl::Barrier::vertex_pull | gl::Barrier::storage);
}

void VertexLight::draw(const Layer& layer) const {
    plain_.draw.bind_input("clip_position", clip_positions_);
    plain_.draw.bind_input("display_color", display_colors_);
    layer.surfaces.draw_plain(plain_.draw);
    if (!layer.surfaces.has_textures()) return;
    textured_->draw.bind_input("clip_position", clip_positions_);
    textured_->draw.bind_input("texture_light", texture_lights_);
    layer.surfaces.draw_textured(textured_->draw);
}

}  // namespace gelatin::render
