#include "render/frame_grabber.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <vector>

#include "render/target.h"
#include "support/gl_fixture.h"

namespace gelatin::render {
namespace {

class FrameGrabberTest : public test::GlTest {};

TEST_F(FrameGrabberTest, GivesFramesInOrderAndUpright) {
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
