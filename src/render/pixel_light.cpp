#include "render/pixel_light.h"

namespace gelatin::render {

PixelLight::PixelLight(const AmbientOcclusion* occlusion, bool is_cut)
    : occlusion_(occlusion), is_cut_(is_cut), program_(make_program({})) {}

gl::Program PixelLight::make_program(const gl::Defines& more) const {
    gl::Defines defines = more;
    if (is_cut_) defines.emplace_back("CUT");
    for (const std::string& define : AmbientOcclusion::defines(occlusion_)) defines.push_back(define);
    if (occlusion_ != nullptr) defines.emplace_back("SOFT_SHADOWS");
    return gl::Program::graphics("render/surface.vert", "render/surface.frag", defines);
}

void PixelLight::set_uniforms(const gl::Program& program, const Frame& frame, const Layer& layer) const {
    frame.view.set_uniforms(program);
    frame.shadows.set_uniforms(program);
    frame.shadows.bind_textures(program);
    if (occlusion_ != nullptr) {
        occlusion_->set_uniforms(program);
        occlusion_->bind_texture(program);
    }
    if (is_cut_) program.set("cut_plane", layer.surfaces.cut_plane());
    program.set("jelly", layer.jelly);
    layer.surfaces.bind(program);
}

void PixelLight::draw(const Frame& frame, std::initializer_list<const Layer*> layers) const {
    for (const Layer* layer : layers) {
        set_uniforms(program_, frame, *layer);
        program_.bind("object_colors", layer->colors);
        layer->surfaces.draw_plain(program_);
        if (!layer->surfaces.has_textures()) continue;
        if (!textured_program_) textured_program_ = make_program({"TEXTURED"});
        set_uniforms(*textured_program_, frame, *layer);
        layer->surfaces.draw_textured(*textured_program_);
    }
}

}  // namespace gelatin::render
