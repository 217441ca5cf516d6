#include "render/renderer_fixture.h"

namespace gelatin::render {
namespace {

class LightTest : public RendererTest {
protected:
    static void expect_ball_shades_floor(Quality quality);
    static void expect_body_shades_body(Quality quality);
};

// The key light comes from the upper left and from the front; the ambient light is the same on the left and
// right.
TEST_F(LightTest, LightFollowsTheNormals) {
    for (const Quality quality : {Quality::high, Quality::fast}) {
        Studio studio;
        studio.options.quality = quality;
        const Image image = picture_of(studio);
        const glm::ivec2 left = pixel_of(studio.camera, {-0.35f, 0.6f, 0.35f});
        const glm::ivec2 right = pixel_of(studio.camera, {0.35f, 0.6f, 0.35f});
        EXPECT_GT(brightness_at(image, left), brightness_at(image, right) + 15.0);
    }
}

TEST_F(LightTest, GivenNormalsAreUsed) {
    // A ball whose normals are all perpendicular to the light is dark where it was bright.
    const Studio studio;
    const StaticMesh ball(studio.bodies);
    const std::vector<glm::vec4> aside(ball.view().vertex_count, glm::vec4(0.70f, 0.10f, 0.71f, 0.0f));
    const gl::Buffer<glm::vec4> normals{std::span<const glm::vec4>(aside)};
    RenderView view = ball.view();
    Renderer renderer(studio.options);
    renderer.set_surroundings(studio.surroundings);
    FrameGrabber grabber(kWidth, kHeight);
    renderer.draw(view, studio.camera);
    grabber.grab(renderer.framebuffer());
    view.vertex_normals = normals.id();
    renderer.draw(view, studio.camera);
    const Image lit = *grabber.grab(renderer.framebuffer());
    const Image dark = *grabber.flush();
    const glm::ivec2 pixel = pixel_of(studio.camera, {-0.2f, 0.9f, 0.35f});
    EXPECT_GT(brightness_at(lit, pixel), brightness_at(dark, pixel) + 20.0);
}

// Seen from behind: the floor where the key light's shadow falls, near the ball where only the sky is
// occluded, and far away.
TEST_F(LightTest, BallShadesTheFloor) {
    for (const Quality quality : {Quality::high, Quality::fast}) expect_ball_shades_floor(quality);
}

void LightTest::expect_ball_shades_floor(Quality quality) {
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

TEST_F(LightTest, OneBodyShadesAnother) {
    for (const Quality quality : {Quality::high, Quality::fast}) expect_body_shades_body(quality);
}

void LightTest::expect_body_shades_body(Quality quality) {
    Studio studio;
    studio.options.quality = quality;
    studio.surroundings.bounds = {{-1.5f, 0.0f, -1.0f}, {0.5f, 2.5f, 1.0f}};
    studio.camera.target = {0.0f, 0.6f, 0.0f};
    const double lit =
        brightness(test::mean_color(picture_of(studio), kWidth / 2 - 8, kHeight / 2 - 12, 5, 5));
    studio.bodies.push_back(sphere_at({-0.88, 2.2, 0.67}, 0.5));  // towards the light
    studio.surroundings.colors.emplace_back(0.05f, 0.05f, 0.8f);
    const Image image = picture_of(studio);
    EXPECT_LT(brightness(test::mean_color(image, kWidth / 2 - 8, kHeight / 2 - 12, 5, 5)), lit - 20.0);
}

}  // namespace
}  // namespace gelatin::render
