#include "render/renderer_fixture.h"

namespace gelatin::render {
namespace {

class FastQualityTest : public RendererTest {};

TEST_F(FastQualityTest, LooksLikeHigh) {
    Studio studio = ball_and_box();
    studio.surroundings.props = {make_box({glm::dvec3(0.4), glm::ivec3(1)})};
    const Image high = picture_of(studio);
    studio.options.quality = Quality::fast;
    const Image fast = picture_of(studio);
    EXPECT_LT(test::perceptual_difference(fast, high), 1.0);
    EXPECT_NE(fast.pixels, high.pixels);
}

// From the middle of the shadow to where there is none, in steps of less than a pixel.
TEST_F(FastQualityTest, ShadowFadesLikeHighs) {
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
TEST_F(FastQualityTest, FollowsCameraAndSurroundings) {
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
TEST_F(FastQualityTest, KeepsNoTraceOfTheFrameBefore) {
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

}  // namespace
}  // namespace gelatin::render
