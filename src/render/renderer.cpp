#include "render/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/common.hpp>
#include <string>

#include "gelatin/error.h"
#include "gl/context.h"
#include "gl/debug.h"
#include "render/fast_pipeline.h"
#include "render/palette.h"
#include "render/up_axis.h"

namespace gelatin::render {
namespace {

constexpr float kShadowReach = 3.0f;  // of the scene's extent

constexpr ShadowDetail kHighShadows{
    .key_map = 1024, .undersides = 192, .floor_light = 192, .few_taps = false, .splat = false};
constexpr ShadowDetail kFastShadows{
    .key_map = 256, .undersides = 96, .floor_light = 80, .few_taps = true, .splat = true};

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
    if (options.quality == Quality::automatic)
        options.quality = gl::Context::current().device().is_software ? Quality::fast : Quality::high;
    return options;
}

// Empty if the bodies' box is that of an earlier time.
std::optional<Bounds> exact_bounds(const RenderView& bodies, const RenderView& props) {
    if (bodies.box_is_late) return {};
    const auto point = [](const float* p) { return glm::vec3(p[0], p[1], p[2]); };
    Bounds bounds{point(bodies.box_min), point(bodies.box_max)};
    if (props.face_count > 0) {
        bounds.add(point(props.box_min));
        bounds.add(point(props.box_max));
    }
    return bounds;
}

std::unique_ptr<Pipeline> make_pipeline(const RendererOptions& options) {
    if (options.quality == Quality::fast)
        return std::make_unique<FastPipeline>(options.width, options.height);
    return std::make_unique<HighPipeline>(options.width, options.height, options.smoothing);
}

}  // namespace

Renderer::Renderer(const RendererOptions& options)
    : options_(checked(options)),
      pipeline_(make_pipeline(options_)),
      shadows_(options_.quality == Quality::fast ? kFastShadows : kHighShadows) {
    glGenVertexArrays(1, &vertex_array_);
    gl::check_errors("setting up the renderer");
}

Renderer::~Renderer() {
    glDeleteVertexArrays(1, &vertex_array_);
}

void Renderer::resize(int width, int height) {
    RendererOptions resized = options_;
    resized.width = width;
    resized.height = height;
    options_ = checked(resized);
    pipeline_->resize(width, height);
    gl::check_errors("resizing the picture");
}

void Renderer::set_surroundings(const Surroundings& surroundings) {
    surroundings_ = surroundings;
    up_ = surroundings.up;
    surroundings_.bounds = to_y_up(surroundings.bounds, up_);
    for (SurfaceMesh& prop : surroundings_.props)
        for (glm::dvec3& p : prop.positions) p = up_ == Axis::z ? glm::dvec3(p.x, p.z, -p.y) : p;
    props_ = StaticMesh(surroundings_.props);
    const std::vector<glm::vec4> prop_colors(std::max<std::size_t>(surroundings.props.size(), 1),
                                             glm::vec4(kPropColor, 1.0f));
    prop_colors_ = gl::Buffer<glm::vec4>(std::span<const glm::vec4>(prop_colors));
    body_colors_ = {};
}

// The maps follow the bodies, with room for their motion in a frame, but within limits.
void Renderer::aim_shadows(const RenderView& bodies, const View& view) {
    const Bounds& usual = view.bounds;
    const glm::vec3 farthest(kShadowReach * view.extent()), room(0.05f * view.extent());
    const auto near_scene = [&](const float* p) {
        const glm::vec3 point(p[0], p[1], p[2]);
        return glm::clamp(point, usual.min - farthest, usual.max + farthest);
    };
    Bounds casters{near_scene(bodies.box_min) - room, near_scene(bodies.box_max) + room};
    if (bodies.node_count == 0) casters = usual;
    shadows_.aim(casters, view.extent(), view.floor_height.value_or(usual.min.y), to_key_light());
}

const gl::Buffer<glm::vec4>& Renderer::colors_of(const RenderView& bodies) {
    const bool distinguishes_objects = bodies.overlay.objects.has_value();
    gl::Buffer<glm::vec4>& buffer = distinguishes_objects ? object_colors_ : body_colors_;
    const std::size_t count = std::max(bodies.object_count, 1u);
    if (buffer.size() >= count) return buffer;
    std::vector<glm::vec4> colors;
    for (std::size_t i = 0; i < count; ++i) {
        const bool given = i < surroundings_.colors.size() && surroundings_.colors[i].r >= 0.0f;
        const glm::vec3 usual = given ? surroundings_.colors[i] : palette_color(i);
        colors.emplace_back(distinguishes_objects ? object_color(i) : usual, 1.0f);
    }
    buffer = gl::Buffer<glm::vec4>(std::span<const glm::vec4>(colors));
    return buffer;
}

void Renderer::draw(const RenderView& given, const Camera& given_camera) {
    gl::forget_state();
    const FramebufferGuard guard;
    glBindVertexArray(vertex_array_);
    glDisable(GL_BLEND);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glDepthFunc(GL_LEQUAL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    if (up_ != Axis::y && !turned_view_) turned_view_.emplace();
    const RenderView bodies = up_ == Axis::y ? given : turned_view_->turn(given);
    const Camera camera = to_y_up(given_camera, up_);
    const SurfaceDraw body_draw(bodies);
    const SurfaceDraw prop_draw(props_.view());
    const gl::BufferTexture body_colors(colors_of(bodies), gl::TexelFormat::rgba32f);
    const gl::BufferTexture prop_colors(prop_colors_, gl::TexelFormat::rgba32f);
    const View view{camera, width(), height(), surroundings_.bounds, surroundings_.floor_height};
    aim_shadows(bodies, view);
    overlay_.show(bodies, view.letter_size());
    shadows_.draw({&body_draw, &prop_draw}, options_.quality == Quality::high || view.shows_floor());
    pipeline_->draw({.view = view,
                     .bodies = {.surfaces = body_draw, .colors = body_colors, .jelly = 1.0f},
                     .props = {.surfaces = prop_draw, .colors = prop_colors, .jelly = 0.0f},
                     .bounds = exact_bounds(bodies, props_.view()),
                     .shadows = shadows_,
                     .overlay = overlay_});
    gl::release_samplers();
    glBindVertexArray(0);
    gl::check_errors("drawing a frame");
}

}  // namespace gelatin::render
