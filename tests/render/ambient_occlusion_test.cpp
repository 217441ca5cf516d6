#include "render/ambient_occlusion.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "mesh/shapes.h"
#include "render/frame_grabber.h"
#include "render/overlay.h"
#include "render/palette.h"
#include "render/renderer.h"
#include "support/gl_fixture.h"
#include "support/image_compare.h"

namespace gelatin::render {
namespace {

constexpr int kViewWidth = 320, kViewHeight = 201;  // an odd one: half of it is not whole
constexpr std::size_t kHalfWidth = 160, kHalfHeight = 101;
const Bounds kBounds{{-0.6f, 0.0f, -0.6f}, {0.6f, 1.0f, 0.6f}};

// Pixels on the floor are small against the reach.
const Camera kNear{{0.1f, 0.8f, 0.9f}, {0.1f, 0.0f, 0.0f}, 35.0f};

SurfaceMesh box_at(const glm::dvec3& center, const glm::dvec3& size) {
    SurfaceMesh mesh = make_box({size, glm::ivec3(1)});
    for (glm::dvec3& p : mesh.positions) p += center;
    return mesh;
}

SurfaceMesh ball_at(const glm::dvec3& center, double radius) {
    SurfaceMesh mesh = make_sphere({radius, 24});
    for (glm::dvec3& p : mesh.positions) p += center;
    return mesh;
}

class AmbientOcclusionTest : public test::GlTest {
protected:
    View view_{.camera = {{0.3f, 1.5f, 3.0f}, {0.0f, 0.3f, 0.0f}, 35.0f},
               .width = kViewWidth,
               .height = kViewHeight,
               .bounds = kBounds,
               .floor_height = 0.0f};
    const float reach_ = AmbientOcclusion::kReach * view_.extent();

    // Works out the picture of openness and distance.
    void draw(const std::vector<SurfaceMesh>& bodies, const std::optional<Bounds>& bounds = {}) {
        unsigned vertex_array = 0;
        glGenVertexArrays(1, &vertex_array);
        glBindVertexArray(vertex_array);
        glDepthFunc(GL_LEQUAL);
        const StaticMesh mesh(bodies);
        const SurfaceDraw surfaces(mesh.view());
        const gl::Buffer<glm::vec4> color(1);
        const gl::BufferTexture colors(color, gl::TexelFormat::rgba32f);
        const Layer layer{.surfaces = surfaces, .colors = colors, .jelly = 1.0f};
        const Shadows shadows(
            {.key_map = 16, .undersides = 16, .floor_light = 16, .few_taps = true, .splat = true});
        AmbientOcclusion occlusion;
        occlusion.resize(view_.width, view_.height);
        occlusion.draw({.view = view_,
                        .bodies = layer,
                        .props = layer,
                        .bounds = bounds,
                        .shadows = shadows,
                        .overlay = Overlay()},
                       {&surfaces});
        glBindTexture(GL_TEXTURE_2D, occlusion.texture());
        pixels_.assign(kHalfWidth * kHalfHeight, glm::vec2(NAN));
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RG, GL_FLOAT, pixels_.data());
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glBindVertexArray(0);
        glDeleteVertexArrays(1, &vertex_array);
    }

    // [0, 1] of the picture, rows from the bottom.
    glm::vec2 place_of(const glm::vec3& point) const {
        const float aspect = static_cast<float>(view_.width) / static_cast<float>(view_.height);
        const glm::vec4 clip = view_.camera.projection(aspect) * view_.camera.view() * glm::vec4(point, 1.0f);
        return 0.5f + 0.5f * glm::vec2(clip) / clip.w;
    }

    glm::vec2 at(const glm::vec3& point) const {
        const glm::vec2 place = place_of(point) * glm::vec2(kHalfWidth, kHalfHeight);
        return pixels_[static_cast<std::size_t>(place.y) * kHalfWidth + static_cast<std::size_t>(place.x)];
    }

    std::vector<glm::vec2> pixels_;
};

TEST_F(AmbientOcclusionTest, WhatIsConvexAndStandsAloneIsOpen) {
    view_.floor_height.reset();
    draw({ball_at({-0.4, 0.3, 0.0}, 0.35), box_at({0.5, 0.4, 0.0}, glm::dvec3(0.5))});
    int of_bodies = 0, of_open_bodies = 0;
    for (const glm::vec2& pixel : pixels_) {
        EXPECT_GE(pixel.x, 0.96f);
        of_open_bodies += pixel.y < 100.0f && pixel.x > 0.995f;
        of_bodies += pixel.y < 100.0f;
    }
    EXPECT_GT(of_bodies, 1500);
    EXPECT_GT(of_open_bodies, of_bodies - 20) << "but at the rim, where normals are those of single pixels";
}

TEST_F(AmbientOcclusionTest, DistancesAreThoseFromTheEye) {
    draw({box_at({0.0, 0.25, 0.0}, glm::dvec3(0.5))});
    const glm::vec3 on_body(0.1f, 0.2f, 0.25f), on_floor(0.2f, 0.0f, 0.6f);
    const glm::vec3 ahead = glm::normalize(view_.camera.target - view_.camera.eye);
    // Half floats, and a pixel's width on a slope.
    EXPECT_NEAR(at(on_body).y, glm::dot(on_body - view_.camera.eye, ahead), 0.02f);
    EXPECT_NEAR(at(on_floor).y, -glm::dot(on_floor - view_.camera.eye, ahead), 0.02f);
}

// A point at distance d before a long wall of height h sees 1/2 + 1/2 d / sqrt(d^2 + h^2) of the sky by the
// cosine; points of the wall are felt up to half the reach to all of it, so that the wall is as good as one
// of a quarter of the reach to all of it.
TEST_F(AmbientOcclusionTest, TheFootOfAWallSeesHalfTheSky) {
    view_.camera = kNear;
    for (const double ground : {0.0, 0.1}) {  // the floor, a plate on it
        std::vector<SurfaceMesh> bodies{box_at({0.0, ground + 1.0, -1.0}, {4.0, 2.0, 2.0})};
        if (ground > 0.0) bodies.push_back(box_at({0.0, 0.5 * ground, 1.0}, {4.0, ground, 2.0}));
        draw(bodies);
        const auto openness = [&](float d) { return at({0.1f, static_cast<float>(ground), d}).x; };
        const float d = 0.15f * reach_;
        const auto open = [&](float h) { return 0.5f + 0.5f * d / std::hypot(d, h); };
        EXPECT_GT(openness(d), open(reach_) - 0.03f) << ground;
        EXPECT_LT(openness(d), open(0.25f * reach_) + 0.03f) << ground;
        EXPECT_GT(openness(0.6f * reach_), openness(d) + 0.1f) << ground;
        EXPECT_GT(openness(1.2f * reach_), 0.99f) << ground;
    }
}

TEST_F(AmbientOcclusionTest, NoHaloRoundWhatIsFarBefore) {
    view_.camera = {{0.0f, 0.5f, 3.0f}, {0.0f, 0.5f, 0.0f}, 35.0f};
    view_.floor_height.reset();
    draw({box_at({0.0, 0.5, -0.5}, {6.0, 4.0, 0.1}), ball_at({0.0, 0.5, 0.3}, 0.2)});
    // At the ball's rim normals are those of its outermost pixels.
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        EXPECT_GE(pixels_[i].x, pixels_[i].y > 3.4f ? 0.99f : 0.96f)
            << pixels_[i].y << " m away, in column " << i % kHalfWidth << ", row " << i / kHalfWidth;
}

// Where nothing is near, nothing is worked out; what is worked out does not depend on that.
TEST_F(AmbientOcclusionTest, KnownBoundsChangeNothing) {
    const std::vector<SurfaceMesh> bodies{ball_at({0.0, 0.2, 0.0}, 0.2),
                                          box_at({0.4, 0.2, 0.0}, glm::dvec3(0.4))};
    draw(bodies);
    const std::vector<glm::vec2> all = pixels_;
    draw(bodies, Bounds{{-0.2f, 0.0f, -0.2f}, {0.6f, 0.4f, 0.2f}});
    int outside = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_NEAR(pixels_[i].x, all[i].x, 1e-3f);
        outside += pixels_[i] != all[i];
    }
    EXPECT_GT(outside, 1000);
}

// Before a wall that the key light shines on: of the floor's light what the sky gives is held back, and that
// alone.
TEST_F(AmbientOcclusionTest, TheKeyLightIsLeftAlone) {
    const auto floor_brightness = [](double openness) {
        const double to_key = 1.0 / glm::length(glm::dvec3(-0.55, 1.0, 0.42));
        // Green, of render/include/studio.glsl; where it is below the shoulder of render/include/tone.glsl.
        const double light = 0.57 * (1.13 * to_key + 0.405 * openness);
        return 255.0 * (1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
    };
    view_.camera = kNear;
    for (const Smoothing smoothing : {Smoothing::samples, Smoothing::filter}) {
        Renderer renderer(
            {.width = kViewWidth, .height = kViewHeight, .quality = Quality::high, .smoothing = smoothing});
        renderer.set_surroundings({.bounds = kBounds, .floor_height = 0.0f, .props = {}, .colors = {}});
        const StaticMesh wall({box_at({0.0, 0.5, -0.5}, {2.0, 1.0, 1.0})});
        renderer.draw(wall.view(), view_.camera);
        FrameGrabber grabber(kViewWidth, kViewHeight);
        grabber.grab(renderer.framebuffer());
        const Image image = *grabber.flush();
        const glm::vec2 place = place_of({0.13f, 0.0f, 0.15f * reach_}) * glm::vec2(kViewWidth, kViewHeight);
        const int x = static_cast<int>(place.x), y = kViewHeight - 1 - static_cast<int>(place.y);
        const double green = test::mean_color(image, x, y, 1, 1).g;
        EXPECT_GT(green, floor_brightness(0.45));
        EXPECT_LT(green, floor_brightness(0.75));
        EXPECT_LT(floor_brightness(0.75), floor_brightness(1.0) - 5.0);
    }
}

// The floor beside a body is dark, the body above it is not.
TEST_F(AmbientOcclusionTest, SurfacesThatMeetKeepTheirOwn) {
    draw({box_at({0.0, 0.25, 0.0}, glm::dvec3(0.5))});
    float darkest_floor = 1.0f;
    for (const glm::vec2& pixel : pixels_) {
        const bool is_floor = pixel.y < 0.0f;
        if (is_floor) darkest_floor = std::min(darkest_floor, pixel.x);
        EXPECT_GE(is_floor ? 1.0f : pixel.x, 0.93f) << pixel.y;
    }
    EXPECT_LT(darkest_floor, 0.7f);
}

// The same of a prop that the key light shines on: at half the openness it has lost no more than half its
// ambient light, which is a third of all.
TEST_F(AmbientOcclusionTest, TheKeyLightOnBodiesIsLeftAlone) {
    view_.camera = kNear;
    Renderer renderer({.width = kViewWidth, .height = kViewHeight, .quality = Quality::high});
    renderer.set_surroundings(
        {.bounds = kBounds,
         .floor_height = {},
         .props = {box_at({0.0, 0.5, -0.5}, {4.0, 1.0, 1.0}), box_at({0.0, -0.05, 0.0}, {4.0, 0.1, 4.0})},
         .colors = {}});
    renderer.draw(StaticMesh(std::vector<SurfaceMesh>{}).view(), view_.camera);
    FrameGrabber grabber(kViewWidth, kViewHeight);
    grabber.grab(renderer.framebuffer());
    const Image image = *grabber.flush();
    const auto light = [&](float from_wall) {
        const glm::vec2 place = place_of({0.1f, 0.0f, from_wall}) * glm::vec2(kViewWidth, kViewHeight);
        const int x = static_cast<int>(place.x), y = kViewHeight - 1 - static_cast<int>(place.y);
        return from_srgb(glm::vec3(test::mean_color(image, x, y, 1, 1) / 255.0)).g;
    };
    EXPECT_LT(light(0.15f * reach_), 0.95f * light(1.2f * reach_));
    EXPECT_GT(light(0.15f * reach_), 0.80f * light(1.2f * reach_));
}

// Half floats hold distances up to 65 km alone.
TEST_F(AmbientOcclusionTest, SizeDoesNotMatter) {
    const auto picture = [](float scale) {
        const auto times = [&](const glm::vec3& v) { return scale * v; };
        Renderer renderer({.width = kViewWidth, .height = kViewHeight, .quality = Quality::high});
        renderer.set_surroundings({.bounds = {times(kBounds.min), times(kBounds.max)},
                                   .floor_height = 0.0f,
                                   .props = {},
                                   .colors = {}});
        std::vector<SurfaceMesh> bodies{ball_at({-0.3, 0.3, 0.0}, 0.3),
                                        box_at({0.3, 0.3, 0.0}, glm::dvec3(0.6))};
        for (SurfaceMesh& body : bodies) {
            for (glm::dvec3& p : body.positions) p *= scale;
        }
        const StaticMesh mesh(bodies);
        renderer.draw(mesh.view(), {times({0.3f, 1.5f, 3.0f}), times({0.0f, 0.3f, 0.0f}), 35.0f});
        FrameGrabber grabber(kViewWidth, kViewHeight);
        grabber.grab(renderer.framebuffer());
        return *grabber.flush();
    };
    const Image usual = picture(1.0f);
    for (const float scale : {1e-3f, 1e4f})
        EXPECT_LT(test::perceptual_difference(picture(scale), usual), 0.5) << scale;
}

}  // namespace
}  // namespace gelatin::render
