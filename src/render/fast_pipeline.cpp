#include "render/fast_pipeline.h"

#include <epoxy/gl.h>

#include "render/overlay.h"

namespace gelatin::render {
namespace {

constexpr int kTiles = 16;                    // a side, as in shaders/render/floor_shadow.vert
constexpr int kShadeResolution = 6 * kTiles;  // [texels a side]

}  // namespace

FastPipeline::FastPipeline(int width, int height)
    : shade_program_(gl::Program::graphics("render/whole_picture.vert", "render/floor_shade.frag")),
      shadow_program_(gl::Program::graphics("render/floor_shadow.vert", "render/floor_shadow.frag")),
      floor_shade_(Target::color(kShadeResolution, kShadeResolution, GL_RGBA8)) {
    FastPipeline::resize(width, height);
}

void FastPipeline::resize(int width, int height) {
    plate_ = Target::color_and_depth(width, height);
    picture_ = Target::color_and_depth(width, height);
    plate_view_.reset();
}

void FastPipeline::draw(const Frame& frame) {
    if (plate_view_ != frame.view) draw_plate(frame.view);
    const bool has_shadows = frame.view.shows_floor();
    if (has_shadows) draw_floor_shade(frame);
    const bool has_bodies = !frame.overlay.replaces_bodies();
    if (has_bodies) body_light_.light(frame, frame.bodies);

    restore_picture(frame);
    picture_.bind();
    glEnable(GL_DEPTH_TEST);
    if (has_bodies) {
        body_light_.draw(frame.bodies);
    } else {
        frame.overlay.draw_bodies(frame);
    }
    prop_light_.draw(frame, {&frame.props});
    if (has_shadows) draw_floor_shadow(frame);
    frame.overlay.draw(frame);
}

void FastPipeline::draw_plate(const View& view) {
    plate_.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    scenery_.draw(view, nullptr);
    plate_view_ = view;
    drawn_ = drawn_depth_ = plate_.pixels();
}

// Only what the frame before has changed.
void FastPipeline::restore_picture(const Frame& frame) {
    plate_.copy_color_to(picture_, drawn_);
    plate_.copy_depth_to(picture_, drawn_depth_);
    drawn_depth_ = frame.bounds ? frame.view.pixels_of(*frame.bounds) : plate_.pixels();
    drawn_ = drawn_depth_.joined(frame.view.pixels_of(frame.shadows.floor_patch()));
    if (!frame.overlay.is_empty()) drawn_ = drawn_depth_ = plate_.pixels();  // lines reach beyond bodies
}

void FastPipeline::draw_floor_shade(const Frame& frame) const {
    floor_shade_.bind();
    glDisable(GL_DEPTH_TEST);
    frame.view.set_uniforms(shade_program_);
    frame.shadows.set_uniforms(shade_program_);
    Scenery::set_floor_uniforms(shade_program_, frame.view);
    frame.shadows.bind_floor_light(shade_program_);
    shade_program_.draw_arrays(gl::Primitive::triangles, 3);
}

// After all that hides the floor.
void FastPipeline::draw_floor_shadow(const Frame& frame) const {
    shadow_program_.bind_texture("floor_shade", floor_shade_.texture());
    frame.view.set_uniforms(shadow_program_);
    frame.shadows.set_uniforms(shadow_program_);
    glEnable(GL_POLYGON_OFFSET_FILL);  // over the floor, which is of other triangles
    glPolygonOffset(-1.0f, -4.0f);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
    glDepthMask(GL_FALSE);
    shadow_program_.draw_arrays(gl::Primitive::triangles, 6 * kTiles * kTiles);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace gelatin::render
