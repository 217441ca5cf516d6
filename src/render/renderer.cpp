#include "render/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "gelatin/error.h"
#include "gl/context.h"
#include "gl/debug.h"
#include "render/palette.h"

namespace gelatin::render {
namespace {

const glm::vec3 kToKeyLight = glm::normalize(glm::vec3(-0.55f, 1.0f, 0.42f));
const glm::vec4 kPropColor(0.34f, 0.37f, 0.42f, 1.0f);
constexpr int kSamples = 4;            // OpenGL promises as many
constexpr float kKeyDistance = 2.0f;   // of the scene's extent
constexpr float kFloorRadius = 11.0f;  // the same
constexpr float kShadowReach = 3.0f;   // the same

RendererOptions checked(RendererOptions options) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    for (const auto& [name, size] :
         {std::pair("width", options.width), std::pair("height", options.height)}) {
        if (size < 1 || size > largest) {
            const std::string allowed = "1 to " + std::to_string(largest) + " pixels on this driver";
            throw InvalidInput({{}, 0, name, std::to_string(size), "must be " + allowed});
        }
    }
    if (options.smoothing == Smoothing::automatic) {
        const bool software = gl::Context::current().device().is_software;
        options.smoothing = software ? Smoothing::filter : Smoothing::samples;
    }
    return options;
}

gl::Defines defines_of(Shading shading) {
    return shading == Shading::node ? gl::Defines{"LIGHT_AT_NODES"} : gl::Defines{};
}

Target make_canvas(const RendererOptions& options) {
    const bool sampled = options.smoothing == Smoothing::samples;
    return sampled ? Target::multisampled(options.width, options.height, kSamples)
                   : Target::color_and_depth(options.width, options.height);
}

float extent_of(const Bounds& bounds) {
    return std::max(glm::length(bounds.size()), 1e-3f);
}

// 1, 2 or 5 times a power of ten, so that some ten lines cross the scene.
float grid_spacing(float extent) {
    const float wanted = extent / 10.0f;
    const float decade = std::pow(10.0f, std::floor(std::log10(wanted)));
    const float mantissa = wanted / decade;
    return decade * (mantissa < 1.5f ? 1.0f : mantissa < 3.5f ? 2.0f : mantissa < 7.5f ? 5.0f : 10.0f);
}

}  // namespace

Renderer::Renderer(const RendererOptions& options)
    : options_(checked(options)),
      surface_program_(
          gl::Program::graphics("render/surface.vert", "render/surface.frag", defines_of(options.shading))),
      floor_program_(gl::Program::graphics("render/floor.vert", "render/floor.frag")),
      backdrop_program_(gl::Program::graphics("render/whole_picture.vert", "render/backdrop.frag")),
      filter_program_(gl::Program::graphics("render/whole_picture.vert", "render/smooth_edges.frag")),
      canvas_(make_canvas(options_)),
      picture_(Target::color(options_.width, options_.height, GL_RGBA8)),
      shadows_(options_.shadow_resolution) {
    glGenVertexArrays(1, &vertex_array_);
    gl::check_errors("setting up the renderer");
}

Renderer::~Renderer() {
    glDeleteVertexArrays(1, &vertex_array_);
}

void Renderer::set_surroundings(const Surroundings& surroundings) {
    surroundings_ = surroundings;
    props_ = StaticMesh(surroundings.props);
    const std::vector<glm::vec4> prop_colors(std::max<std::size_t>(surroundings.props.size(), 1), kPropColor);
    prop_colors_ = gl::Buffer<glm::vec4>(std::span<const glm::vec4>(prop_colors));
    body_colors_ = {};
}

// The maps follow the bodies, with room for what they move in a frame, but not to the end of the world.
void Renderer::aim_shadows(const RenderView& bodies) {
    const Bounds& usual = surroundings_.bounds;
    const float extent = extent_of(usual);
    const glm::vec3 farthest(kShadowReach * extent), room(0.05f * extent);
    const auto near_scene = [&](const float* p) {
        const glm::vec3 point(p[0], p[1], p[2]);
        return glm::clamp(point, usual.min - farthest, usual.max + farthest);
    };
    Bounds casters{near_scene(bodies.box_min) - room, near_scene(bodies.box_max) + room};
    if (bodies.node_count == 0) casters = usual;
    shadows_.aim(casters, extent, surroundings_.floor_height.value_or(usual.min.y), kToKeyLight);
}

void Renderer::grow_colors(std::uint32_t body_count) {
    if (body_colors_.size() >= std::max(body_count, 1u)) return;
    std::vector<glm::vec4> colors;
    for (std::size_t i = 0; i < std::max(body_count, 1u); ++i) {
        const bool given = i < surroundings_.colors.size() && surroundings_.colors[i].r >= 0.0f;
        colors.emplace_back(given ? surroundings_.colors[i] : palette_color(i), 1.0f);
    }
    body_colors_ = gl::Buffer<glm::vec4>(std::span<const glm::vec4>(colors));
}

void Renderer::draw(const RenderView& bodies, const Camera& camera) {
    const FramebufferGuard guard;
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::vertex_pull);
    glBindVertexArray(vertex_array_);
    glDisable(GL_BLEND);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glDepthFunc(GL_LEQUAL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    grow_colors(bodies.object_count);
    const SurfaceDraw body_draw(bodies);
    const SurfaceDraw prop_draw(props_.view());
    aim_shadows(bodies);
    shadows_.draw({&body_draw, &prop_draw});
    canvas_.bind();
    draw_scene(body_draw, prop_draw, camera);

    smooth_edges();
    glBindSampler(4, 0);
    glBindVertexArray(0);
    gl::check_errors("drawing a frame");
}

void Renderer::smooth_edges() const {
    if (options_.smoothing == Smoothing::filter) {
        picture_.bind();
        glDisable(GL_DEPTH_TEST);
        glActiveTexture(GL_TEXTURE7);
        glBindTexture(GL_TEXTURE_2D, canvas_.texture());
        glBindSampler(7, 0);
        filter_program_.set("pixel_size", 1.0f / glm::vec2(width(), height()));
        filter_program_.use();
        glDrawArrays(GL_TRIANGLES, 0, 3);
        return;
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas_.framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, picture_.framebuffer());
    glBlitFramebuffer(0, 0, width(), height(), 0, 0, width(), height(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Renderer::set_frame_uniforms(const gl::Program& program, const Camera& camera) const {
    const float aspect = static_cast<float>(width()) / static_cast<float>(height());
    program.set("world_to_clip", camera.projection(aspect) * camera.view());
    program.set("to_key_light", kToKeyLight);
    program.set("picture_size", glm::vec2(width(), height()));
    program.set("eye", camera.eye);
    const float key_distance = kKeyDistance * extent_of(surroundings_.bounds);
    program.set("key_distance", key_distance);
    program.set("key_position", surroundings_.bounds.center() + key_distance * kToKeyLight);
    shadows_.set_uniforms(program);
    program.use();
}

// From the nearest to the farthest, so that what is hidden is not lit.
void Renderer::draw_scene(const SurfaceDraw& bodies, const SurfaceDraw& props, const Camera& camera) const {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);  // the backdrop covers every pixel's colour
    shadows_.bind_textures();

    set_frame_uniforms(surface_program_, camera);
    surface_program_.set("jelly", 1.0f);
    const gl::BufferTexture body_colors(body_colors_, gl::TexelFormat::rgba32f);
    body_colors.bind(3);
    bodies.draw();
    surface_program_.set("jelly", 0.0f);
    const gl::BufferTexture prop_colors(prop_colors_, gl::TexelFormat::rgba32f);
    prop_colors.bind(3);
    props.draw();

    if (surroundings_.floor_height) draw_floor(camera);
    set_frame_uniforms(backdrop_program_, camera);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::draw_floor(const Camera& camera) const {
    if (camera.eye.y <= *surroundings_.floor_height) return;
    set_frame_uniforms(floor_program_, camera);
    const float extent = extent_of(surroundings_.bounds);
    glm::vec3 center = surroundings_.bounds.center();
    center.y = *surroundings_.floor_height;
    floor_program_.set("floor_center", center);
    floor_program_.set("floor_radius", kFloorRadius * extent);
    floor_program_.set("grid_spacing", grid_spacing(extent));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace gelatin::render
