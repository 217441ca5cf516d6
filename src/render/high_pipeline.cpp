#include "render/high_pipeline.h"

#include <epoxy/gl.h>

#include <glm/vec2.hpp>

#include "gl/context.h"
#include "render/overlay.h"

namespace gelatin::render {
namespace {

constexpr int kSamples = 4;  // OpenGL promises as many

Smoothing chosen(Smoothing smoothing) {
    if (smoothing != Smoothing::automatic) return smoothing;
    return gl::Context::current().device().is_software ? Smoothing::filter : Smoothing::samples;
}

}  // namespace

HighPipeline::HighPipeline(int width, int height, Smoothing smoothing)
    : smoothing_(chosen(smoothing)),
      filter_program_(gl::Program::graphics("render/whole_picture.vert", "render/smooth_edges.frag")) {
    HighPipeline::resize(width, height);
}

void HighPipeline::resize(int width, int height) {
    canvas_ = smoothing_ == Smoothing::samples ? Target::multisampled(width, height, kSamples)
                                               : Target::color_and_depth(width, height);
    occlusion_.resize(width, height);
    picture_ = Target::color(width, height, GL_RGBA8);
}

// From the nearest to the farthest, so that what is hidden is not lit.
void HighPipeline::draw(const Frame& frame) {
    const bool has_bodies = !frame.overlay.replaces_bodies();
    if (has_bodies) {
        occlusion_.draw(frame, {&frame.bodies.surfaces, &frame.props.surfaces});
    } else {
        occlusion_.draw(frame, {&frame.props.surfaces});
    }
    canvas_.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);  // the backdrop covers every pixel's colour
    if (has_bodies) {
        light_.draw(frame, {&frame.bodies});
    } else {
        frame.overlay.draw_bodies(frame);
    }
    light_.draw(frame, {&frame.props});
    scenery_.draw(frame.view, &frame.shadows);
    frame.overlay.draw(frame);
    smooth_edges();
}

void HighPipeline::smooth_edges() const {
    const int width = picture_.width(), height = picture_.height();
    if (smoothing_ == Smoothing::filter) {
        picture_.bind();
        glDisable(GL_DEPTH_TEST);
        filter_program_.bind_texture("picture", canvas_.texture());
        filter_program_.set("pixel_size", 1.0f / glm::vec2(width, height));
        filter_program_.draw_arrays(gl::Primitive::triangles, 3);
        return;
    }
    canvas_.copy_color_to(picture_);
}

}  // namespace gelatin::render
