#include "render/pixel_light.h"

namespace gelatin::render {

namespace {

gl::Defines with_occlusion(gl::Defines defines, const AmbientOcclusion* occlusion) {
    for (const std::string& define : AmbientOcclusion::defines(occlusion)) defines.push_back(define);
    if (occlusion != nullptr) defines.emplace_back("SOFT_SHADOWS");
    return defines;
}

}  // namespace

PixelLight::PixelLight(const AmbientOcclusion* occlusion, const gl::Defines& defines)
    : occlusion_(occlusion),
      program_(gl::Program::graphics("render/surface.vert", "render/surface.frag",
                                     with_occlusion(defines, occlusion))) {}

void PixelLight::draw(const Frame& frame, std::initializer_list<const Layer*> layers) const {
    frame.view.set_uniforms(program_);
    frame.shadows.set_uniforms(program_);
    frame.shadows.bind_textures(program_);
    if (occlusion_ != nullptr) {
        occlusion_->set_uniforms(program_);
        occlusion_->bind_texture(program_);
    }
    for (const Layer* layer : layers) {
        program_.set("jelly", layer->jelly);
        program_.bind("object_colors", layer->colors);
        layer->surfaces.draw(program_);
    }
}

}  // namespace gelatin::render
