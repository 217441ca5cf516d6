#include "render/scenery.h"

#include <epoxy/gl.h>

#include <cmath>

namespace gelatin::render {
namespace {

constexpr float kFloorRadius = 11.0f;  // of the scene's extent

// 1, 2 or 5 times a power of ten, so that about ten lines cross the scene.
float grid_spacing(float extent) {
    const float wanted = extent / 10.0f;
    const float decade = std::pow(10.0f, std::floor(std::log10(wanted)));
    const float mantissa = wanted / decade;
    return decade * (mantissa < 1.5f ? 1.0f : mantissa < 3.5f ? 2.0f : mantissa < 7.5f ? 5.0f : 10.0f);
}

}  // namespace

Scenery::Scenery(const AmbientOcclusion* occlusion)
    : occlusion_(occlusion),
      floor_program_(gl::Program::graphics("render/floor.vert", "render/floor.frag",
                                           AmbientOcclusion::defines(occlusion))),
      backdrop_program_(gl::Program::graphics("render/whole_picture.vert", "render/backdrop.frag")) {}

void Scenery::set_floor_uniforms(const gl::Program& program, const View& view) {
    glm::vec3 center = view.bounds.center();
    center.y = *view.floor_height;
    program.set("floor_center", center);
    program.set("floor_radius", kFloorRadius * view.extent());
}

void Scenery::draw(const View& view, const Shadows* shadows) const {
    if (view.shows_floor()) {
        view.set_uniforms(floor_program_);
        set_floor_uniforms(floor_program_, view);
        floor_program_.set("grid_spacing", grid_spacing(view.extent()));
        if (occlusion_ != nullptr) occlusion_->set_uniforms(floor_program_);
        if (shadows != nullptr) {
            shadows->set_uniforms(floor_program_);
        } else {
            floor_program_.set("floor_patch", glm::vec4(0.0f));  // all of the floor is outside
        }
        floor_program_.use();
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    view.set_uniforms(backdrop_program_);
    backdrop_program_.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace gelatin::render
