#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "render/frame_grabber.h"
#include "render/renderer.h"
#include "render/static_mesh.h"
#include "support/gl_fixture.h"

namespace gelatin::render {
namespace {

class ResizeTest : public test::GlTest {};

const Surroundings kSurroundings{
    .bounds = {{-0.5f, 0.0f, -0.5f}, {0.5f, 1.0f, 0.5f}}, .floor_height = 0.0f, .props = {}, .colors = {}};

Image picture_of(Renderer& renderer) {
    const StaticMesh ball({make_sphere({0.4, 8})});
    renderer.draw(ball.view(), {{0.0f, 1.2f, 4.0f}, {0.0f, 0.2f, 0.0f}, 35.0f});
    FrameGrabber grabber(renderer.width(), renderer.height());
    grabber.grab(renderer.framebuffer());
    return *grabber.flush();
}

// Larger, smaller and back: nothing of another size is left.
TEST_F(ResizeTest, PicturesAreThoseOfARendererOfThatSize) {
    for (const Quality quality : {Quality::high, Quality::fast}) {
        Renderer resized({.width = 64, .height = 48, .quality = quality});
        resized.set_surroundings(kSurroundings);
        picture_of(resized);
        for (const auto& [width, height] : {std::pair(160, 90), std::pair(50, 70), std::pair(64, 48)}) {
            Renderer fresh({.width = width, .height = height, .quality = quality});
            fresh.set_surroundings(kSurroundings);
            resized.resize(width, height);
            EXPECT_EQ(picture_of(resized).pixels, picture_of(fresh).pixels) << width << " x " << height;
        }
    }
}

}  // namespace
}  // namespace gelatin::render
