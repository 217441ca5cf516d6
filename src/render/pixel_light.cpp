#include "render/pixel_light.h"

namespace gelatin::render {

PixelLight::PixelLight(const gl::Defines& defines)
    : program_(gl::Program::graphics("render/surface.vert", "render/surface.frag", defines)) {}

void PixelLight::draw(const Frame& frame, std::initializer_list<const Layer*> layers) const {
    frame.view.set_uniforms(program_);
    frame.shadows.set_uniforms(program_);
    program_.use();
    for (const Layer* layer : layers) {
        program_.set("jelly", layer->jelly);
        layer->colors.bind(3);
        layer->surfaces.draw();
    }
}

}  // namespace gelatin::render
