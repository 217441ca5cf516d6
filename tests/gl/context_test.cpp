#include "gl/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdio>
#include <optional>
#include <string>

#include "gelatin/error.h"
#include "gl/buffer.h"
#include "gl/debug.h"
#include "support/environment.h"
#include "support/gl_fixture.h"

namespace gelatin::gl {
namespace {

using ::testing::HasSubstr;

class ContextTest : public test::GlTest {};

TEST_F(ContextTest, DescribesItsDevice) {
    const DeviceInfo& device = context().device();
    EXPECT_FALSE(device.vendor.empty());
    EXPECT_FALSE(device.renderer.empty());
    EXPECT_GE(device.max_storage_block_bytes, std::size_t{1} << 24);  // what OpenGL 4.3 promises
    EXPECT_GE(device.max_texture_buffer_texels, std::size_t{65'536});
    EXPECT_GE(device.max_work_groups_x, 65'535u);
    EXPECT_EQ(device.is_software, device.renderer.find("llvmpipe") != std::string::npos);
}

TEST_F(ContextTest, IsAtLeastVersion43) {
    EXPECT_GE(epoxy_gl_version(), 43);
}

TEST_F(ContextTest, OneAfterAnotherWorkAndLeaveTheFirstUsable) {
    const Buffer<float> before(std::vector<float>{1.0f, 2.0f, 3.0f});
    for (int i = 0; i < 5; ++i) {
        Context other = Context::headless({.device_index = {}, .debug = true});
        const Buffer<float> buffer(std::vector<float>{4.0f, 5.0f});
        std::vector<float> out(2);
        buffer.download(out);
        EXPECT_EQ(out, (std::vector<float>{4.0f, 5.0f}));
    }
    EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT) << "a context that ends stays current";
    context().make_current();
    std::vector<float> out(3);
    before.download(out);
    EXPECT_EQ(out, (std::vector<float>{1.0f, 2.0f, 3.0f}));
}

TEST_F(ContextTest, MovesAndLeavesTheSourceHarmless) {
    Context first = Context::headless();
    const Context second = std::move(first);
    EXPECT_NE(eglGetCurrentContext(), EGL_NO_CONTEXT);
    EXPECT_EQ(second.device().renderer, context().device().renderer);
}

TEST_F(ContextTest, UsesAndLeavesTheHostsContext) {
    EGLContext host = eglGetCurrentContext();
    {
        Context view = Context::current();
        EXPECT_EQ(view.device().renderer, context().device().renderer);
        view.make_current();
    }
    EXPECT_EQ(eglGetCurrentContext(), host);
}

TEST_F(ContextTest, OpensAnEglDeviceByIndex) {
    std::optional<Context> by_index;
    try {
        by_index = Context::headless({.device_index = 0, .debug = false});
    } catch (const NoOpenGl& error) {
        GTEST_SKIP() << error.what();
    }
    EXPECT_FALSE(by_index->device().renderer.empty());
    const test::EnvironmentVariable variable("GELATIN_EGL_DEVICE", "0");
    EXPECT_EQ(Context::headless().device().renderer, by_index->device().renderer);
}

TEST_F(ContextTest, RefusesADeviceThatIsNotThere) {
    try {
        Context::headless({.device_index = 4711, .debug = false});
        FAIL() << "expected NoOpenGl";
    } catch (const NoOpenGl& error) {
        EXPECT_THAT(error.what(), HasSubstr("no EGL device 4711"));
    }
}

TEST_F(ContextTest, RefusesADeviceIndexThatIsNoNumber) {
    for (const char* value : {"gpu", "-1", "1x"}) {
        const test::EnvironmentVariable variable("GELATIN_EGL_DEVICE", value);
        try {
            Context::headless();
            FAIL() << "expected InvalidInput for " << value;
        } catch (const InvalidInput& error) {
            EXPECT_THAT(error.what(), HasSubstr(std::string("GELATIN_EGL_DEVICE = ") + value));
        }
    }
}

TEST_F(ContextTest, DebugMessagesAreCollected) {
    glEnable(GL_TEXTURE_2D);  // not in the core profile
    EXPECT_EQ(glGetError(), GLenum{GL_INVALID_ENUM});
    const std::vector<std::string> messages = take_debug_messages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_THAT(messages[0], HasSubstr("OpenGL error: "));
    EXPECT_TRUE(take_debug_messages().empty());
}

TEST_F(ContextTest, CheckErrorsNamesTheErrorAndClearsIt) {
    glEnable(GL_TEXTURE_2D);
    take_debug_messages();
    try {
        check_errors("the frob");
        FAIL() << "expected GlError";
    } catch (const GlError& error) {
        EXPECT_STREQ(error.what(), "the frob: GL_INVALID_ENUM");
    }
    EXPECT_NO_THROW(check_errors("the frob"));
}

// Death tests of the thread-safe style run in a process of their own, where no driver has been loaded yet.
class NoContextDeathTest : public ::testing::Test {
protected:
    NoContextDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

    [[noreturn]] static void report(Context (*make)()) {
        ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
        try {
            make();
        } catch (const NoOpenGl& error) {
            std::fprintf(stderr, "<%s>", error.what());
            ::_exit(4);
        }
        ::_exit(0);
    }
};

TEST_F(NoContextDeathTest, NoDriverIsOneClearLine) {
    EXPECT_EXIT(report([] { return Context::headless(); }), ::testing::ExitedWithCode(4),
                "<EGL offers no OpenGL 4.3 core context: install a driver with [^\n]*>");
}

TEST_F(NoContextDeathTest, NoCurrentContextIsSaidSo) {
    EXPECT_EXIT(report([] { return Context::current(); }), ::testing::ExitedWithCode(4),
                "<no OpenGL context is current on this thread>");
}

}  // namespace
}  // namespace gelatin::gl
