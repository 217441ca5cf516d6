#include "render/vertex_light.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "mesh/shapes.h"
#include "render/overlay.h"
#include "support/gl_fixture.h"

namespace gelatin::render {
namespace {

constexpr int kLightWidth = 320, kLightHeight = 200;
const glm::vec4 kColor(0.7f, 0.2f, 0.05f, 1.0f);

// The part of light that is mirrored.
double schlick(double cosine) {
    return 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
}

// The formula of shaders/render/include/light.glsl in double, where nothing casts a shadow or is near.
glm::dvec3 lit(const View& view, const glm::dvec3& position, const glm::dvec3& normal, double jelly) {
    const glm::dvec3 key_light(1.20, 1.13, 1.03), sky_light(0.37, 0.405, 0.455),
        floor_light(0.33, 0.305, 0.28);
    const glm::dvec3 horizon(0.755, 0.765, 0.775), zenith(0.39, 0.465, 0.575);
    const glm::dvec3 albedo(kColor);
    const double key_distance = 2.0 * glm::length(glm::dvec3(view.bounds.size()));
    const glm::dvec3 key_position =
        glm::dvec3(view.bounds.center()) + key_distance * glm::normalize(glm::dvec3(-0.55, 1.0, 0.42));

    const glm::dvec3 to_eye = glm::normalize(glm::dvec3(view.camera.eye) - position);
    const double distance = glm::distance(key_position, position);
    const double strength = std::pow(key_distance / distance, 2.0);
    const glm::dvec3 to_key = (key_position - position) / distance;
    const double facing = glm::dot(normal, to_key);

    const double wrap = 0.35 * jelly;
    const double diffuse = std::max((facing + wrap) / (1.0 + wrap), 0.0);
    const glm::dvec3 deep = albedo * glm::sqrt(albedo);
    const glm::dvec3 key =
        glm::mix(deep, albedo, std::clamp(1.5 * diffuse + 1.0 - jelly, 0.0, 1.0)) * diffuse;
    const double through = 0.5 * std::clamp(0.4 - 0.8 * facing, 0.0, 1.0);
    const glm::dvec3 ambient = glm::mix(floor_light, sky_light, 0.5 + 0.5 * normal.y);

    const glm::dvec3 half_way = glm::normalize(to_key + to_eye);
    const double square = std::pow(0.28, 4.0);
    const double along = std::max(glm::dot(normal, half_way), 0.0);
    const double gloss = 0.25 * square / std::pow(along * along * (square - 1.0) + 1.0, 2.0) *
                         schlick(std::max(glm::dot(to_eye, half_way), 0.0)) * std::max(facing, 0.0);
    const glm::dvec3 mirrored = glm::reflect(-to_eye, normal);
    const glm::dvec3 around = glm::mix(floor_light, glm::mix(horizon, zenith, std::max(mirrored.y, 0.0)),
                                       glm::smoothstep(-0.25, 0.25, mirrored.y));
    const double edge = 0.55 * schlick(std::max(glm::dot(normal, to_eye), 0.0)) * glm::mix(0.2, 1.0, jelly);
    return albedo * ambient + key_light * strength * (0.85 * key + jelly * (gloss + through * deep)) +
           around * edge;
}

// That of tone.glsl.
glm::dvec3 displayed(const glm::dvec3& light) {
    const double peak = std::max({light.r, light.g, light.b});
    const double over = std::max(peak - 0.72, 0.0);
    const double shown = peak - over + 0.28 * over / (over + 0.28);
    const double white = 1.0 - 1.0 / (0.3 * (peak - shown) + 1.0);
    const glm::dvec3 compressed = glm::mix(light * shown / peak, glm::dvec3(shown), white);
    const glm::dvec3 a = glm::sqrt(compressed), b = glm::sqrt(a), c = glm::sqrt(b);
    return glm::clamp(0.585122381 * a + 0.783140355 * b - 0.368262736 * c, 0.0, 1.0);
}

glm::dvec3 unpacked(std::uint32_t color) {
    return glm::dvec3(color & 255u, (color >> 8) & 255u, (color >> 16) & 255u) / 255.0;
}

// A ball that stands alone, lit without a floor; what its vertices became.
class VertexLightTest : public test::GlTest {
protected:
    static constexpr int kFrequency = 5;
    const View view_{.camera = {{1.0f, 1.5f, 4.0f}, {0.0f, 0.2f, 0.0f}, 35.0f},
                     .width = kLightWidth,
                     .height = kLightHeight,
                     .bounds = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}},
                     .floor_height = {}};
    const SurfaceMesh ball_ = make_sphere({0.5, kFrequency});

    void light(double jelly) {
        const std::uint32_t count = static_cast<std::uint32_t>(ball_.positions.size());
        std::vector<glm::vec4> points, radial;
        std::vector<glm::uvec4> same;  // surface vertex v is node v of object 0
        for (std::uint32_t v = 0; v < count; ++v) {
            points.emplace_back(glm::vec3(ball_.positions[v]), 0.0f);
            radial.emplace_back(glm::vec3(glm::normalize(ball_.positions[v])), 0.0f);
            same.emplace_back(v, 0u, 0u, 0u);
        }
        const gl::Buffer<glm::vec4> positions{std::span<const glm::vec4>(points)};
        const gl::Buffer<glm::vec4> normals{std::span<const glm::vec4>(radial)};
        const gl::Buffer<glm::uvec4> vertices{std::span<const glm::uvec4>(same)};
        const gl::Buffer<glm::uvec3> triangles{std::span<const glm::uvec3>(ball_.faces)};
        const SurfaceDraw surfaces({.node_positions = positions.id(),
                                    .surface_vertices = vertices.id(),
                                    .vertex_normals = normals.id(),
                                    .triangles = triangles.id(),
                                    .node_count = count,
                                    .vertex_count = count,
                                    .face_count = static_cast<std::uint32_t>(ball_.faces.size()),
                                    .object_count = 1});
        const gl::Buffer<glm::vec4> color{std::span(&kColor, 1)};
        const gl::BufferTexture colors(color, gl::TexelFormat::rgba32f);
        Shadows shadows(
            {.key_map = 64, .undersides = 16, .floor_light = 16, .few_taps = true, .splat = true});
        shadows.aim(view_.bounds, view_.extent(), -0.5f, to_key_light());
        shadows.draw({}, false);

        const Layer layer{.surfaces = surfaces, .colors = colors, .jelly = static_cast<float>(jelly)};
        VertexLight vertex_light;
        vertex_light.light({.view = view_,
                            .bodies = layer,
                            .props = layer,
                            .bounds = {},
                            .shadows = shadows,
                            .overlay = Overlay()},
                           layer);
        gl::barrier(gl::Barrier::buffer_update);
        clip_positions_.resize(vertex_light.clip_positions().size(), glm::vec4(NAN));
        vertex_light.clip_positions().download(clip_positions_);
        display_colors_.resize(vertex_light.display_colors().size());
        vertex_light.display_colors().download(display_colors_);
        gl::release_samplers();
    }

    std::vector<glm::vec4> clip_positions_;
    std::vector<std::uint32_t> display_colors_;
};

// Half a step of 8 bits, and single precision where the tone curve is steep.
TEST_F(VertexLightTest, ColorsFollowTheFormula) {
    for (const double jelly : {0.0, 1.0}) {
        light(jelly);
        ASSERT_EQ(display_colors_.size(), ball_.positions.size());
        ASSERT_NE(display_colors_.size() % 64, 0u);
        for (std::size_t v = 0; v < ball_.positions.size(); ++v) {
            const glm::dvec3& p = ball_.positions[v];
            const glm::dvec3 expected = displayed(lit(view_, p, glm::normalize(p), jelly));
            const glm::dvec3 difference = glm::abs(unpacked(display_colors_[v]) - expected);
            EXPECT_LT(std::max({difference.r, difference.g, difference.b}), 0.6 / 255.0) << "vertex " << v;
        }
    }
}

TEST_F(VertexLightTest, PositionsAreThoseOfTheCamera) {
    light(1.0);
    const glm::mat4 to_clip =
        view_.camera.projection(static_cast<float>(kLightWidth) / kLightHeight) * view_.camera.view();
    ASSERT_EQ(clip_positions_.size(), ball_.positions.size());
    for (std::size_t v = 0; v < ball_.positions.size(); ++v) {
        const glm::vec4 expected = to_clip * glm::vec4(glm::vec3(ball_.positions[v]), 1.0f);
        EXPECT_LT(glm::distance(clip_positions_[v], expected), 1e-5f);
    }
}

}  // namespace
}  // namespace gelatin::render
