#include "gelatin/picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/file.h"
#include "gelatin/error.h"
#include "picture/scene_painter.h"
#include "render/frame_grabber.h"
#include "render/image.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

using PictureTest = test::SimulatorFixture;

PictureOptions small() {
    PictureOptions options;
    options.width = 120;
    options.height = 80;
    return options;
}

TEST_F(PictureTest, IsWhatTheCommandLineDraws) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(test::falling_balls(), on(backend));
        simulator.advance_frame();
        for (const PictureQuality quality : {PictureQuality::fast, PictureQuality::high}) {
            PictureOptions options = small();
            options.quality = quality;
            const Picture picture = render_picture(simulator, options);
            EXPECT_EQ(picture.width, 120);
            EXPECT_EQ(picture.height, 80);
            ASSERT_EQ(picture.pixels.size(), 3u * 120u * 80u);
            ScenePainter painter(
                simulator, {120, 80},
                quality == PictureQuality::fast ? render::Quality::fast : render::Quality::high);
            render::FrameGrabber grabber(120, 80);
            painter.draw();
            grabber.grab(painter.framebuffer());
            EXPECT_EQ(picture.pixels, grabber.flush()->pixels);
            EXPECT_NE(*std::min_element(picture.pixels.begin(), picture.pixels.end()),
                      *std::max_element(picture.pixels.begin(), picture.pixels.end()));
        }
    }
}

TEST_F(PictureTest, APainterFollowsTheStateTheCameraAndTheOverlays) {
    Simulator simulator(test::falling_balls(), on(Backend::cpu));
    PicturePainter painter(simulator, small());
    const Picture first = painter.paint();
    EXPECT_EQ(painter.paint().pixels, first.pixels);
    EXPECT_EQ(render_picture(simulator, small()).pixels, first.pixels);
    for (int f = 0; f < 30; ++f) simulator.advance_frame();
    const Picture later = painter.paint();
    EXPECT_NE(later.pixels, first.pixels);
    Overlays overlays;
    overlays.wireframe = true;
    painter.set_overlays(overlays);
    EXPECT_NE(painter.paint().pixels, later.pixels);
    painter.set_overlays({});
    EXPECT_EQ(painter.paint().pixels, later.pixels);
    const CameraDescription camera{{3.0, 2.0, 1.0}, {0.0, 0.5, 0.0}, 50.0};
    painter.set_camera(camera);
    const Picture aside = painter.paint();
    EXPECT_NE(aside.pixels, later.pixels);
    PictureOptions options = small();
    options.camera = camera;
    Simulator again(test::falling_balls(), on(Backend::cpu));
    for (int f = 0; f < 30; ++f) again.advance_frame();
    EXPECT_EQ(render_picture(again, options).width, aside.width);
}

TEST_F(PictureTest, IsWrittenAsPng) {
    const TemporaryFolder folder;
    Simulator simulator(test::falling_balls(), on(Backend::cpu));
    const Picture picture = render_picture(simulator, small());
    save_picture(folder.path() / "a.png", picture);
    EXPECT_EQ(render::read_png(folder.path() / "a.png").pixels, picture.pixels);
    EXPECT_THROW(save_picture(folder.path() / "nowhere" / "a.png", picture), SystemError);
}

TEST_F(PictureTest, NeedsAContextAndASize) {
    SimulatorOptions blind;
    blind.backend = Backend::cpu;
    Simulator simulator(test::falling_balls(), blind);
    EXPECT_THROW(render_picture(simulator), NoOpenGl);
    Simulator seeing(test::falling_balls(), on(Backend::cpu));
    PictureOptions options;
    options.width = 0;
    EXPECT_THROW(render_picture(seeing, options), InvalidInput);
}

}  // namespace
}  // namespace gelatin
