#include "render/shadows.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace gelatin::render {
namespace {

constexpr float kLightSize = 0.11f;       // tangent of the key light's apparent radius: a large soft box
constexpr float kPenumbraLeast = 0.006f;  // of the scene's extent
constexpr float kPenumbraMost = 0.07f;
constexpr float kSkyRadius = 0.35f;
constexpr float kFreePath = 0.07f;

// Clip coordinates to texture coordinates and depth.
const glm::mat4 kHalf =
    glm::translate(glm::mat4(1.0f), glm::vec3(0.5f)) * glm::scale(glm::mat4(1.0f), glm::vec3(0.5f));

// A patch that no point is inside of.
const glm::vec4 kNowhere(0.0f);

Target make_depth_map(int resolution, bool splat) {
    // Splats are uploaded as integers of 32 bits, which need no conversion then.
    return Target::depth(resolution, resolution, splat ? GL_DEPTH_COMPONENT32 : GL_DEPTH_COMPONENT24);
}

gl::Defines taps(const ShadowDetail& detail) {
    return detail.few_taps ? gl::Defines{"FEW_TAPS"} : gl::Defines{};
}

}  // namespace

Shadows::Shadows(const ShadowDetail& detail)
    : depth_program_(gl::Program::graphics("render/surface_depth.vert", "render/surface_depth.frag")),
      floor_program_(
          gl::Program::graphics("render/whole_picture.vert", "render/floor_visibility.frag", taps(detail))),
      blend_program_(gl::Program::graphics("render/whole_picture.vert", "render/floor_blend.frag")),
      shadow_map_(make_depth_map(detail.key_map, detail.splat)),
      underside_(make_depth_map(detail.undersides, detail.splat)),
      floor_visibility_(Target::color(detail.floor_light, detail.floor_light, GL_RG8)),
      floor_light_(Target::color(detail.floor_light, detail.floor_light, GL_RG8)) {
    if (detail.splat) splats_.emplace();
    glGenSamplers(1, &compare_sampler_);
    glSamplerParameteri(compare_sampler_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(compare_sampler_, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glSamplerParameteri(compare_sampler_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(compare_sampler_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(compare_sampler_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(compare_sampler_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Shadows::~Shadows() {
    glDeleteSamplers(1, &compare_sampler_);
}

void Shadows::aim(const Bounds& casters, float extent, float floor_height, const glm::vec3& to_light) {
    floor_height_ = floor_height;
    extent_ = extent;
    const glm::vec3 center = casters.center();
    const glm::mat4 view = glm::lookAt(center + to_light, center, glm::vec3(0.0f, 0.0f, -1.0f));

    Bounds seen{glm::vec3(view * glm::vec4(center, 1.0f)), glm::vec3(view * glm::vec4(center, 1.0f))};
    Bounds patch{center, center};
    for (const glm::vec3& corner : casters.corners()) {
        seen.add(glm::vec3(view * glm::vec4(corner, 1.0f)));
        patch.add(corner);
        patch.add(corner - to_light * ((corner.y - floor_height) / to_light.y));
    }
    const glm::vec3 room(0.04f * extent_);
    seen = {seen.min - room, seen.max + room};
    light_size_ = seen.size();
    world_to_light_ =
        glm::ortho(seen.min.x, seen.max.x, seen.min.y, seen.max.y, -seen.max.z, -seen.min.z) * view;

    const float reach = (kPenumbraMost + kSkyRadius) * extent_;
    patch_corner_ = glm::vec2(patch.min.x, patch.min.z) - reach;
    patch_size_ = glm::vec2(patch.max.x, patch.max.z) + reach - patch_corner_;
    // x and z to the picture, height to depth.
    world_to_floor_ = glm::mat4(0.0f);
    world_to_floor_[0][0] = 2.0f / patch_size_.x;
    world_to_floor_[2][1] = 2.0f / patch_size_.y;
    world_to_floor_[1][2] = 2.0f / extent_;
    world_to_floor_[3] = glm::vec4(-2.0f * patch_corner_.x / patch_size_.x - 1.0f,
                                   -2.0f * patch_corner_.y / patch_size_.y - 1.0f,
                                   -2.0f * floor_height / extent_ - 1.0f, 1.0f);
}

void Shadows::draw_depths(std::span<const DepthMap> maps, std::initializer_list<const SurfaceDraw*> casters) {
    if (splats_) return splats_->draw(maps, casters);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glEnable(GL_DEPTH_CLAMP);  // what lies before or behind a map still casts into it
    for (const DepthMap& map : maps) {
        map.target.bind();
        glClear(GL_DEPTH_BUFFER_BIT);
        for (const SurfaceDraw* caster : casters) {
            if (caster->is_cut()) {
                draw_cut_depth(map, *caster);
                continue;
            }
            depth_program_.set("world_to_clip", map.world_to_clip);
            caster->draw(depth_program_);
        }
    }
    glDisable(GL_DEPTH_CLAMP);
}

// Without the cut's own face, which light that falls through would leave by the body's other side: faces seen
// from within cast its shadow.
void Shadows::draw_cut_depth(const DepthMap& map, const SurfaceDraw& caster) {
    if (!cut_depth_program_)
        cut_depth_program_ =
            gl::Program::graphics("render/surface_depth.vert", "render/surface_depth.frag", {"CUT"});
    cut_depth_program_->set("world_to_clip", map.world_to_clip);
    cut_depth_program_->set("cut_plane", caster.cut_plane());
    glDisable(GL_CULL_FACE);
    const Clipping clipping(caster);
    caster.draw(*cut_depth_program_);
    glEnable(GL_CULL_FACE);
}

void Shadows::set_penumbra(const gl::Program& program) const {
    program.set("world_to_shadow", kHalf * world_to_light_);
    program.set("shadow_scale", glm::vec2(1.0f / light_size_.x, 1.0f / light_size_.y));
    program.set("shadow_range", light_size_.z);
    program.set("light_size", kLightSize);
    program.set("penumbra_least", kPenumbraLeast * extent_);
    program.set("penumbra_most", kPenumbraMost * extent_);
}

void Shadows::draw_floor_visibility() const {
    floor_visibility_.bind();
    const gl::Program& program = floor_program_;
    program.bind_texture("shadow_map", shadow_map_.texture());
    program.bind_texture("underside", underside_.texture());
    set_penumbra(program);
    program.set("underside_range", extent_);
    program.set("sky_radius", kSkyRadius * extent_);
    program.set("patch_corner", patch_corner_);
    program.set("patch_size", patch_size_);
    program.set("floor_height", floor_height_);
    program.draw_arrays(gl::Primitive::triangles, 3);
}

void Shadows::draw_floor_light() const {
    floor_light_.bind();
    blend_program_.bind_texture("visibility", floor_visibility_.texture());
    blend_program_.set("pixel_size", glm::vec2(1.0f / static_cast<float>(floor_visibility_.width())));
    blend_program_.draw_arrays(gl::Primitive::triangles, 3);
}

void Shadows::draw(std::initializer_list<const SurfaceDraw*> casters, bool lights_floor) {
    lights_floor_ = lights_floor;
    const DepthMap maps[] = {{shadow_map_, world_to_light_}, {underside_, world_to_floor_}};
    draw_depths(std::span(maps).first(lights_floor ? 2 : 1), casters);
    if (!lights_floor) return;
    glDisable(GL_DEPTH_TEST);
    draw_floor_visibility();
    draw_floor_light();
}

void Shadows::set_uniforms(const gl::Program& program) const {
    set_penumbra(program);
    const float texel = std::max(light_size_.x, light_size_.y) / static_cast<float>(shadow_map_.width());
    program.set("shadow_bias", 3.0f * texel);
    program.set("free_path", kFreePath * extent_);
    program.set("shadow_blur", 1.5f / static_cast<float>(shadow_map_.width()));
    const glm::vec4 patch(patch_corner_, 1.0f / patch_size_.x, 1.0f / patch_size_.y);
    program.set("floor_patch", lights_floor_ ? patch : kNowhere);
    program.set("floor_height", floor_height_);
    program.set("floor_reach", 0.35f * extent_);
}

Bounds Shadows::floor_patch() const {
    const glm::vec2 far_corner = patch_corner_ + patch_size_;
    return {{patch_corner_.x, floor_height_, patch_corner_.y}, {far_corner.x, floor_height_, far_corner.y}};
}

void Shadows::bind_textures(const gl::Program& program) const {
    program.bind_texture("shadow_map", shadow_map_.texture(), compare_sampler_);
    program.bind_texture("shadow_depths", shadow_map_.texture());
    bind_floor_light(program);
}

void Shadows::bind_floor_light(const gl::Program& program) const {
    program.bind_texture("floor_light", floor_light_.texture());
}

}  // namespace gelatin::render
