#include "render/scenery.h"

#include <cassert>
#include <cmath>

namespace gelatin::render {
namespace {

constexpr float kFloorRadius = 11.0f;  // of the scene's extent

// 1, 2 or 5 times a power of ten, so that some ten lines cross the scene.
float grid_spacing(float extent) {
    const float wanted = extent / 10.0f;
    const float decade = std::pow(10.0f, std::floor(std::log10(wanted)));
    const float mantissa = wanted / decade;
    return decade * (mantissa < 1.5f ? 1.0f : mantissa < 3.5f ? 2.0f : mantissa < 7.5f ? 5.0f : 10.0f);
}

}  // namespace

Scenery::Scenery()
    : floor_program_(gl::Program::graphics("render/floor.vert", "render/floor.frag")),
      backdrop_program_(gl::Program::graphics("render/whole_picture.vert", "render/backdrop.frag")) {}

Scenery::Scenery(const AmbientOcclusion& occlusion) : Scenery() {
    occlusion_ = &occlusion;
    gl::Defines defines = AmbientOcclusion::defines(&occlusion);
    defines.emplace_back("SHADOWED");
    floor_program_ = gl::Program::graphics("render/floor.vert", "render/floor.frag", defines);
}

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
        assert((shadows != nullptr) == (occlusion_ != nullptr));
        if (shadows != nullptr) {
            occlusion_->set_uniforms(floor_program_);
            occlusion_->bind_texture(floor_program_);
            shadows->set_uniforms(floor_program_);
            shadows->bind_floor_light(floor_program_);
        }
        floor_program_.draw_arrays(gl::Primitive::triangle_strip, 4);
    }
    view.set_uniforms(backdrop_program_);
    backdrop_program_.draw_arrays(gl::Primitive::triangles, 3);
}

}  // namespace gelatin::render
