#include "render/ambient_occlusion.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace gelatin::render {
namespace {

constexpr float kSameSurface = 0.15f;  // of the reach
constexpr int kBlur = 2;               // how far the blur looks [pixels]

// Open and far away, where nothing more is worked out.
void clear(const Target& target) {
    target.bind();
    const float open[] = {1.0f, 6e4f, 0.0f, 0.0f};  // half floats end at 65,504
    glClearBufferfv(GL_COLOR, 0, open);
}

// The pixels of the half picture in which something within reach of bodies shows.
void scissor(const Frame& frame, float reach) {
    if (!frame.bounds) return;
    const glm::vec3 room(reach);
    const PixelRect rect = frame.view.pixels_of({frame.bounds->min - room, frame.bounds->max + room});
    const int left = rect.left / 2 - kBlur, bottom = rect.bottom / 2 - kBlur;
    glEnable(GL_SCISSOR_TEST);
    glScissor(left, bottom, std::max(rect.right / 2 + kBlur + 1 - left, 0),
              std::max(rect.top / 2 + kBlur + 1 - bottom, 0));
}

}  // namespace

AmbientOcclusion::AmbientOcclusion()
    : depth_program_(gl::Program::graphics("render/surface_depth.vert", "render/surface_depth.frag")),
      occlusion_program_(gl::Program::graphics("render/whole_picture.vert", "render/ambient_occlusion.frag")),
      blur_program_(gl::Program::graphics("render/whole_picture.vert", "render/blur_occlusion.frag")) {}

void AmbientOcclusion::resize(int width, int height) {
    const int half_width = (width + 1) / 2, half_height = (height + 1) / 2;
    depths_ = Target::depth(half_width, half_height, GL_DEPTH_COMPONENT24);
    rough_ = Target::color(half_width, half_height, GL_RG16F);
    smooth_ = Target::color(half_width, half_height, GL_RG16F);
    width_ = static_cast<float>(width);
    height_ = static_cast<float>(height);
}

void AmbientOcclusion::draw(const Frame& frame, std::initializer_list<const SurfaceDraw*> occluders) {
    const float reach = kReach * frame.view.extent();
    same_surface_ = kSameSurface * reach;
    draw_depths(frame.view, occluders);
    clear(rough_);
    clear(smooth_);

    glDisable(GL_DEPTH_TEST);
    scissor(frame, reach);
    rough_.bind();
    occlusion_program_.bind_texture("body_depths", depths_.texture());
    set_view(frame.view);
    occlusion_program_.set("reach", reach);
    occlusion_program_.draw_arrays(gl::Primitive::triangles, 3);

    smooth_.bind();
    blur_program_.bind_texture("occlusion", rough_.texture());
    blur_program_.set("same_surface", same_surface_);
    blur_program_.draw_arrays(gl::Primitive::triangles, 3);
    glDisable(GL_SCISSOR_TEST);
}

void AmbientOcclusion::draw_depths(const View& view,
                                   std::initializer_list<const SurfaceDraw*> occluders) const {
    depths_.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    view.set_uniforms(depth_program_);
    for (const SurfaceDraw* occluder : occluders) occluder->draw(depth_program_);
}

void AmbientOcclusion::set_view(const View& view) const {
    const glm::mat4 projection = view.camera.projection(width_ / height_);
    const glm::vec3 up(view.camera.view()[1]);
    const glm::vec4 floor_plane =
        view.shows_floor() ? glm::vec4(up, view.camera.eye.y - *view.floor_height) : glm::vec4(0, 0, 0, 1);
    const glm::vec2 step =
        2.0f / glm::vec2(depths_.width(), depths_.height()) / glm::vec2(projection[0][0], projection[1][1]);
    occlusion_program_.set("ray_step", step);
    occlusion_program_.set("first_ray", 0.5f * step - 1.0f / glm::vec2(projection[0][0], projection[1][1]));
    // distance = P32 / (2 depth - 1 + P22)
    occlusion_program_.set("depth_terms", 0.5f * glm::vec2(projection[3][2], projection[2][2] - 1.0f));
    occlusion_program_.set("floor_plane", floor_plane);
}

gl::Defines AmbientOcclusion::defines(const AmbientOcclusion* occlusion) {
    return occlusion != nullptr ? gl::Defines{"AMBIENT_OCCLUSION"} : gl::Defines{};
}

void AmbientOcclusion::set_uniforms(const gl::Program& program) const {
    const glm::vec2 size(smooth_.width(), smooth_.height());
    program.set("occlusion_scale", size / glm::vec2(width_, height_));
    program.set("same_surface", same_surface_);
}

void AmbientOcclusion::bind_texture(const gl::Program& program) const {
    program.bind_texture("occlusion", smooth_.texture());
}

}  // namespace gelatin::render
