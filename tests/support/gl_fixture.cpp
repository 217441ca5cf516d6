#include "support/gl_fixture.h"

#include <epoxy/gl.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "gelatin/error.h"
#include "gl/debug.h"
#include "gl/hazards.h"

namespace gelatin::test {
namespace {

struct SharedContext {
    std::optional<gl::Context> context;
    std::string why_not;
};

SharedContext& shared() {
    static SharedContext instance = [] {
        SharedContext made;
        try {
            gl::enable_hazard_tracking();
            made.context = gl::Context::headless({.device_index = {}, .debug = true});
        } catch (const NoOpenGl& error) {
            made.why_not = error.what();
        }
        return made;
    }();
    return instance;
}

bool gl_is_required() {
    const char* value = std::getenv("GELATIN_REQUIRE_GL");
    return value != nullptr && std::string_view(value) == "1";
}

// Ends the context before the driver's own clean-up at exit.
class ContextEnd : public ::testing::Environment {
public:
    void TearDown() override { shared().context.reset(); }
};
[[maybe_unused]] const auto* const kContextEnd = ::testing::AddGlobalTestEnvironment(new ContextEnd);

}  // namespace

// Members of fixtures may be GL objects.
GlTest::GlTest() {
    if (shared().context) context().make_current();
}

gl::Context& GlTest::context() {
    return *shared().context;
}

void GlTest::ignore_debug_messages() {
    gl::take_debug_messages();
}

void GlTest::SetUp() {
    if (!shared().context) {
        if (gl_is_required()) FAIL() << shared().why_not;
        GTEST_SKIP() << shared().why_not;
    }
    context().make_current();
    gl::take_debug_messages();
    gl::take_hazards();
}

void GlTest::TearDown() {
    if (!shared().context) return;
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    for (const std::string& message : gl::take_debug_messages()) ADD_FAILURE() << message;
    for (const std::string& hazard : gl::take_hazards()) ADD_FAILURE() << hazard;
}

}  // namespace gelatin::test
