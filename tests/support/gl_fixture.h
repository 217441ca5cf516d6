#pragma once

#include <gtest/gtest.h>

#include "gl/context.h"

namespace gelatin::test {

/// A test with the process' one headless debug context current. Without OpenGL it is skipped, or fails where
/// GELATIN_REQUIRE_GL=1. Any debug message or GL error that is left when the test ends fails it.
class GlTest : public ::testing::Test {
protected:
    GlTest();
    void SetUp() override;
    void TearDown() override;

    /// The shared context; tests that make one of their own call `context().make_current()` when they are
    /// done.
    static gl::Context& context();

    /// For tests that provoke the driver: forgets what it said until now.
    static void ignore_debug_messages();
};

}  // namespace gelatin::test
