#include "render/renderer.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "gelatin/error.h"
#include "render/renderer_fixture.h"
#include "support/source_path.h"

namespace gelatin::render {
namespace {

using test::mean_color;
using ::testing::HasSubstr;

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

TEST_F(RendererTest, LooksAsItDid) {
    for (const auto& [quality, name] :
         {std::pair(Quality::high, "studio.png"), std::pair(Quality::fast, "studio_fast.png")}) {
        Studio studio = ball_and_box();
        studio.options.quality = quality;
        const Image image = picture_of(studio);
        const auto file = std::filesystem::path(test::source_path("tests/render/references")) / name;
        if (std::getenv("GELATIN_UPDATE_REFERENCES") != nullptr) write_png(file, image);
        EXPECT_LT(test::perceptual_difference(image, read_png(file)), 1.0)
            << "if the new picture is better, set GELATIN_UPDATE_REFERENCES=1 once";
    }
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

}  // namespace
}  // namespace gelatin::render
