#include "render/renderer.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <vector>

#include "gelatin/error.h"
#include "mesh/shapes.h"
#include "render/frame_grabber.h"
#include "support/gl_fixture.h"
#include "support/image_compare.h"

namespace gelatin::render {
namespace {

using test::mean_color;
using ::testing::HasSubstr;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

SurfaceMesh sphere_at(const glm::dvec3& center, double radius = 0.5) {
    SurfaceMesh mesh = make_sphere({radius, 12});
    for (glm::dvec3& p : mesh.positions) p += center;
    return mesh;
}

// A red ball of radius 0.5 over the floor, seen from the front and somewhat above.
struct Studio {
    std::vector<SurfaceMesh> bodies = {sphere_at({0.0, 0.6, 0.0})};
    Surroundings surroundings{.bounds = {{-0.5f, 0.0f, -0.5f}, {0.5f, 1.1f, 0.5f}},
                              .floor_height = 0.0f,
                              .props = {},
                              .colors = {{0.8f, 0.05f, 0.05f}}};
    Camera camera{{0.0f, 1.2f, 4.0f}, {0.0f, 0.5f, 0.0f}, 35.0f};
    RendererOptions options{.width = kWidth, .height = kHeight};
};

class RendererTest : public test::GlTest {
protected:
    static Image picture_of(const Studio& studio) {
        Renderer renderer(studio.options);
        renderer.set_surroundings(studio.surroundings);
        const StaticMesh bodies(studio.bodies);
        renderer.draw(bodies.view(), studio.camera);
        FrameGrabber grabber(renderer.width(), renderer.height());
        grabber.grab(renderer.framebuffer());
        return *grabber.flush();
    }

    static Studio ball_and_box() {
        Studio studio;
        studio.options.width = 320;
        studio.options.height = 180;
        studio.bodies.push_back(make_box({glm::dvec3(0.5), glm::ivec3(2)}));
        for (glm::dvec3& p : studio.bodies.back().positions) p += glm::dvec3(1.0, 0.25, 0.0);
        studio.surroundings.bounds.max.x = 1.3f;
        studio.camera = frame_bounds(studio.surroundings.bounds, 320.0f / 180.0f);
        return studio;
    }

    static void expect_ball_shades_floor(Quality quality);
    static void expect_body_shades_body(Quality quality);

    static double brightness(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3.0; }

    // Where a point in space is in the picture.
    static glm::ivec2 pixel_of(const Camera& camera, const glm::vec3& point) {
        const float aspect = static_cast<float>(kWidth) / kHeight;
        const glm::vec4 clip = camera.projection(aspect) * camera.view() * glm::vec4(point, 1.0f);
        return {static_cast<int>((0.5f + 0.5f * clip.x / clip.w) * kWidth),
                static_cast<int>((0.5f - 0.5f * clip.y / clip.w) * kHeight)};
    }

    static double brightness_at(const Image& image, const glm::ivec2& pixel) {
        return brightness(mean_color(image, pixel.x - 1, pixel.y - 1, 3, 3));
    }

    static bool is_red(const std::uint8_t* pixel) {
        return pixel[0] > 2 * pixel[1] && pixel[0] > 2 * pixel[2];
    }

    static double different_fraction(const Image& a, const Image& b) {
        int different = 0;
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x) different += std::abs(a.at(x, y)[1] - b.at(x, y)[1]) > 30;
        }
        return static_cast<double>(different) / (a.width * a.height);
    }

    static double red_fraction(const Image& image) {
        int red = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) red += is_red(image.at(x, y));
        }
        return static_cast<double>(red) / (image.width * image.height);
    }
};

// At distance d the sphere's outline is a cone of half angle asin(r / d): r / sqrt(d^2 - r^2) on the image
// plane.
TEST_F(RendererTest, BodyCoversAsMuchOfThePictureAsItShould) {
    Studio studio;
    studio.surroundings.floor_height.reset();
    studio.camera = {{0.0f, 0.6f, 4.0f}, {0.0f, 0.6f, 0.0f}, 35.0f};
    const double outline = 0.5 / std::sqrt(4.0 * 4.0 - 0.25) / std::tan(std::acos(-1.0) * 35.0 / 360.0);
    const double expected = std::acos(-1.0) * outline * outline / 4.0 * kHeight / kWidth;
    Studio empty = studio;
    empty.bodies.clear();
    const Image backdrop = picture_of(empty);
    for (const Quality quality : {Quality::high, Quality::fast}) {
        studio.options.quality = quality;
        EXPECT_NEAR(different_fraction(picture_of(studio), backdrop), expected, 0.03 * expected);
    }
}

TEST_F(RendererTest, NothingButFloorAndBackdropWithoutBodies) {
    Studio studio;
    studio.bodies.clear();
    const Image image = picture_of(studio);
    EXPECT_EQ(red_fraction(image), 0.0);
    EXPECT_GT(brightness(mean_color(image, 0, 0, kWidth, kHeight)), 100.0);
}

TEST_F(RendererTest, BackdropIsUntouchedByBodies) {
    Studio studio;
    const Image with = picture_of(studio);
    studio.bodies.clear();
    const Image without = picture_of(studio);
    const std::size_t rows = 3 * std::size_t{kWidth} * 20;
    EXPECT_TRUE(std::equal(with.pixels.begin(), with.pixels.begin() + static_cast<std::ptrdiff_t>(rows),
                           without.pixels.begin()));
}

// The key light comes from the upper left and from the front; the ambient light is the same on the left and
// right.
TEST_F(RendererTest, LightFollowsTheNormals) {
    for (const Quality quality : {Quality::high, Quality::fast}) {
        Studio studio;
        studio.options.quality = quality;
        const Image image = picture_of(studio);
        const glm::ivec2 left = pixel_of(studio.camera, {-0.35f, 0.6f, 0.35f});
        const glm::ivec2 right = pixel_of(studio.camera, {0.35f, 0.6f, 0.35f});
        EXPECT_GT(brightness_at(image, left), brightness_at(image, right) + 15.0);
    }
}

TEST_F(RendererTest, GivenNormalsAreUsed) {
    // A ball whose normals all point to the light is bright where light only grazed it.
    const Studio studio;
    const StaticMesh ball(studio.bodies);
    const std::vector<glm::vec4> to_light(ball.view().vertex_count, glm::vec4(to_key_light(), 0.0f));
    const gl::Buffer<glm::vec4> normals{std::span<const glm::vec4>(to_light)};
    RenderView view = ball.view();
    Renderer renderer(studio.options);
    renderer.set_surroundings(studio.surroundings);
    FrameGrabber grabber(kWidth, kHeight);
    renderer.draw(view, studio.camera);
    grabber.grab(renderer.framebuffer());
    view.vertex_normals = normals.id();
    renderer.draw(view, studio.camera);
    const Image grazed = *grabber.grab(renderer.framebuffer());
    const Image lit = *grabber.flush();
    const glm::ivec2 pixel = pixel_of(studio.camera, {0.3f, 0.75f, 0.37f});
    EXPECT_GT(brightness_at(lit, pixel), brightness_at(grazed, pixel) + 20.0);
}

// Seen from behind: the floor where the key light's shadow falls, beside the ball where only sky is hidden,
// and afar.
TEST_F(RendererTest, BallShadesTheFloor) {
    for (const Quality quality : {Quality::high, Quality::fast}) expect_ball_shades_floor(quality);
}

void RendererTest::expect_ball_shades_floor(Quality quality) {
    Studio studio;
    studio.options.quality = quality;
    studio.camera = {{-3.0f, 3.0f, -3.0f}, {0.0f, 0.0f, 0.0f}, 35.0f};
    const glm::ivec2 shadow = pixel_of(studio.camera, {0.5f, 0.0f, -0.45f});
    const glm::ivec2 beside = pixel_of(studio.camera, {-0.31f, 0.0f, -0.01f});
    const glm::ivec2 afar = pixel_of(studio.camera, {-1.2f, 0.0f, -1.2f});
    const Image with = picture_of(studio);
    studio.bodies = {sphere_at({0.0, -5.0, 0.0})};  // under the floor: hidden, and no shadow
    const Image under = picture_of(studio);
    studio.bodies.clear();
    const Image without = picture_of(studio);
    EXPECT_LT(test::perceptual_difference(under, without), 1.0);
    EXPECT_LT(brightness_at(with, shadow), brightness_at(without, shadow) - 30.0);
    EXPECT_LT(brightness_at(with, beside), brightness_at(without, beside) - 0.5);
    EXPECT_GT(brightness_at(with, beside), brightness_at(with, shadow) + 20.0);
    EXPECT_NEAR(brightness_at(with, afar), brightness_at(without, afar), 1.0);
    EXPECT_GT(brightness_at(without, shadow), 150.0);
}

TEST_F(RendererTest, OneBodyShadesAnother) {
    for (const Quality quality : {Quality::high, Quality::fast}) expect_body_shades_body(quality);
}

void RendererTest::expect_body_shades_body(Quality quality) {
    Studio studio;
    studio.options.quality = quality;
    studio.surroundings.bounds = {{-1.5f, 0.0f, -1.0f}, {0.5f, 2.5f, 1.0f}};
    studio.camera.target = {0.0f, 0.6f, 0.0f};
    const double lit = brightness(mean_color(picture_of(studio), kWidth / 2 - 8, kHeight / 2 - 12, 5, 5));
    studio.bodies.push_back(sphere_at({-0.88, 2.2, 0.67}, 0.5));  // towards the light
    studio.surroundings.colors.emplace_back(0.05f, 0.05f, 0.8f);
    const Image image = picture_of(studio);
    EXPECT_LT(brightness(mean_color(image, kWidth / 2 - 8, kHeight / 2 - 12, 5, 5)), lit - 20.0);
}

TEST_F(RendererTest, ColorsComeFromTheObjectAndThePalette) {
    Studio studio;
    studio.bodies = {sphere_at({-0.6, 0.6, 0.0}, 0.4), sphere_at({0.6, 0.6, 0.0}, 0.4)};
    studio.surroundings.bounds = {{-1.0f, 0.0f, -0.5f}, {1.0f, 1.0f, 0.5f}};
    studio.surroundings.colors = {{-1.0f, 0.0f, 0.0f}, {0.02f, 0.1f, 0.9f}};
    const Image image = picture_of(studio);
    const glm::dvec3 left = mean_color(image, 50, 58, 6, 6);
    const glm::dvec3 right = mean_color(image, 104, 58, 6, 6);
    EXPECT_GT(left.r, left.b + 40.0) << "the palette begins with vermilion";
    EXPECT_GT(right.b, right.r + 40.0);
}

TEST_F(RendererTest, PropsAreDrawn) {
    Studio studio;
    studio.bodies.clear();
    const Image without = picture_of(studio);
    studio.surroundings.props = {make_box({glm::dvec3(0.8), glm::ivec3(1)})};
    const Image with = picture_of(studio);
    EXPECT_LT(brightness(mean_color(with, 76, 66, 8, 8)),
              brightness(mean_color(without, 76, 66, 8, 8)) - 20.0);
}

TEST_F(RendererTest, EverySmoothingGivesTheSamePicture) {
    Studio studio;
    studio.options.smoothing = Smoothing::none;
    const Image rough = picture_of(studio);
    for (const Smoothing smoothing : {Smoothing::samples, Smoothing::filter}) {
        studio.options.smoothing = smoothing;
        const Image smooth = picture_of(studio);
        EXPECT_LT(test::perceptual_difference(smooth, rough), 1.5);
        EXPECT_NE(smooth.pixels, rough.pixels);
    }
}

// Along the outline a smooth picture has colours between the body's and the floor's; a rough one has none.
TEST_F(RendererTest, SmoothingBlendsEdges) {
    const auto blended = [](Smoothing smoothing) {
        Studio studio;
        studio.options.smoothing = smoothing;
        const Image image = picture_of(studio);
        int count = 0;
        for (int y = 30; y < 90; ++y) {
            for (int x = 40; x < kWidth / 2; ++x) {
                // The ball is deep red, the floor light grey: saturation tells how much of each is in a
                // pixel.
                const auto* p = image.at(x, y);
                const double saturation =
                    1.0 - static_cast<double>(std::min(p[1], p[2])) / std::max<int>(p[0], 1);
                count += saturation > 0.12 && saturation < 0.45;
            }
        }
        return count;
    };
    const int rough = blended(Smoothing::none);
    EXPECT_GT(blended(Smoothing::samples), rough + 10);
    EXPECT_GT(blended(Smoothing::filter), rough + 10);
}

TEST_F(RendererTest, LooksAsItDid) {
    for (const auto& [quality, name] :
         {std::pair(Quality::high, "studio.png"), std::pair(Quality::fast, "studio_fast.png")}) {
        Studio studio = ball_and_box();
        studio.options.quality = quality;
        const Image image = picture_of(studio);
        const auto file = std::filesystem::path(GELATIN_SOURCE_DIR "/tests/render/references") / name;
        if (std::getenv("GELATIN_UPDATE_REFERENCES") != nullptr) write_png(file, image);
        EXPECT_LT(test::perceptual_difference(image, read_png(file)), 1.0)
            << "if the new picture is better, set GELATIN_UPDATE_REFERENCES=1 once";
    }
}

TEST_F(RendererTest, FastLooksLikeHigh) {
    Studio studio = ball_and_box();
    studio.surroundings.props = {make_box({glm::dvec3(0.4), glm::ivec3(1)})};
    const Image high = picture_of(studio);
    studio.options.quality = Quality::fast;
    const Image fast = picture_of(studio);
    EXPECT_LT(test::perceptual_difference(fast, high), 1.0);
    EXPECT_NE(fast.pixels, high.pixels);
}

// From the middle of the shadow to where there is none, in steps of less than a pixel.
TEST_F(RendererTest, FastShadowFadesLikeHighs) {
    Studio studio;
    studio.camera = {{2.0f, 5.0f, -2.0f}, {0.0f, 0.0f, 0.0f}, 35.0f};
    const Image high = picture_of(studio);
    studio.options.quality = Quality::fast;
    const Image fast = picture_of(studio);
    for (int i = 0; i <= 100; ++i) {
        const float distance = 0.01f * static_cast<float>(i);
        const glm::ivec2 pixel =
            pixel_of(studio.camera, {0.5f + 0.8f * distance, 0.0f, -0.45f - 0.6f * distance});
        EXPECT_NEAR(brightness_at(fast, pixel), brightness_at(high, pixel), 12.0) << distance;
    }
}

// The floor and the backdrop of the fast quality are kept from frame to frame.
TEST_F(RendererTest, FastFollowsCameraAndSurroundings) {
    Studio studio;
    studio.options.quality = Quality::fast;
    const StaticMesh bodies(studio.bodies);
    Renderer renderer(studio.options);
    const auto next_picture = [&] {
        renderer.set_surroundings(studio.surroundings);
        renderer.draw(bodies.view(), studio.camera);
        FrameGrabber grabber(kWidth, kHeight);
        grabber.grab(renderer.framebuffer());
        return *grabber.flush();
    };
    next_picture();
    studio.camera.eye.x += 1.0f;
    EXPECT_EQ(next_picture().pixels, picture_of(studio).pixels);
    studio.surroundings.floor_height = -0.5f;
    EXPECT_EQ(next_picture().pixels, picture_of(studio).pixels);
    studio.surroundings.floor_height.reset();
    EXPECT_EQ(next_picture().pixels, picture_of(studio).pixels);
}

// Of each frame it restores no more than the next one needs.
TEST_F(RendererTest, FastKeepsNoTraceOfTheFrameBefore) {
    Studio studio;
    studio.options.quality = Quality::fast;
    Renderer renderer(studio.options);
    const auto draw = [&](const RenderView& view) { renderer.draw(view, studio.camera); };
    const auto expect_picture_of = [&](const std::vector<SurfaceMesh>& bodies) {
        studio.bodies = bodies;
        draw(StaticMesh(bodies).view());
        FrameGrabber grabber(kWidth, kHeight);
        grabber.grab(renderer.framebuffer());
        EXPECT_EQ(grabber.flush()->pixels, picture_of(studio).pixels);
    };
    // As from a GPU, with a box that the body has left.
    const auto draw_with_late_box = [&] {
        const StaticMesh body({sphere_at({0.5, 0.4, 0.0}, 0.2)});
        RenderView view = body.view();
        view.box_is_late = true;
        view.box_min[0] = view.box_max[0] = -0.5f;
        draw(view);
    };
    for (int props = 0; props < 2; ++props) {
        SCOPED_TRACE(props);
        if (props == 1) studio.surroundings.props = {make_box({glm::dvec3(0.3), glm::ivec3(1)})};
        renderer.set_surroundings(studio.surroundings);
        expect_picture_of({sphere_at({0.6, 0.9, 0.3}), sphere_at({-0.4, 0.5, 0.0})});
        expect_picture_of({sphere_at({0.0, 0.6, 0.0})});
        expect_picture_of({sphere_at({-3.0, 1.5, 0.0}, 0.2)});                     // out of the picture
        expect_picture_of({sphere_at({0.3, 1.2, 4.0}, 0.4), sphere_at({}, 0.2)});  // the eye inside
        expect_picture_of({sphere_at({-0.7, 0.3, 0.0}, 0.2)});
        draw_with_late_box();
        expect_picture_of({sphere_at({0.0, 0.6, 0.0})});
        studio.surroundings.props.clear();  // the next ones come where none were
    }
    renderer.set_surroundings(studio.surroundings);
    expect_picture_of({sphere_at({0.9, 1.0, 0.0}, 0.2)});
}

TEST_F(RendererTest, LeavesTheHostsFramebufferAndViewport) {
    const Target host = Target::color(32, 16, GL_RGBA8);
    host.bind();
    picture_of(Studio());
    GLint framebuffer = 0;
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    EXPECT_EQ(static_cast<unsigned>(framebuffer), host.framebuffer());
    EXPECT_EQ(viewport, (std::array<GLint, 4>{0, 0, 32, 16}));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

TEST_F(RendererTest, RefusesPicturesThatCannotBe) {
    try {
        const Renderer renderer({.width = 0, .height = 100});
        FAIL() << "expected InvalidInput";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("width = 0: must be 1 to "));
    }
    EXPECT_THROW(Renderer({.width = 100, .height = 1'000'000}), InvalidInput);
}

TEST_F(RendererTest, FrameGrabberGivesFramesInOrderAndUpright) {
    const Target target = Target::color(4, 2, GL_RGBA8);
    FrameGrabber grabber(4, 2);
    std::vector<Image> images;
    for (int i = 0; i < 3; ++i) {
        target.bind();
        glClearColor(static_cast<float>(i) / 255.0f, 0.0f, 0.0f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 1, 4, 1);  // the upper row
        glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        glDisable(GL_SCISSOR_TEST);
        if (auto image = grabber.grab(target.framebuffer())) images.push_back(*image);
    }
    EXPECT_EQ(images.size(), 2u);
    images.push_back(*grabber.flush());
    EXPECT_FALSE(grabber.flush());
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(images[static_cast<std::size_t>(i)].at(3, 0)[0], 255);
        EXPECT_EQ(images[static_cast<std::size_t>(i)].at(3, 1)[0], i);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace
}  // namespace gelatin::render
