#include "gl/fence.h"

#include <gtest/gtest.h>

#include <utility>

#include "gl/timer.h"
#include "support/gl_fixture.h"

namespace gelatin::gl {
namespace {

class FenceTest : public test::GlTest {};

TEST_F(FenceTest, WhatWasBeforeItIsDoneAfterTheWait) {
    TimestampStageTimer timer;  // whose results are there once the GPU has passed them
    timer.begin("nothing");
    timer.end();
    Fence::insert().wait();
    EXPECT_EQ(timer.take().count("nothing"), 1u);
}

TEST_F(FenceTest, IsPassedSomeTimeWithoutAWait) {
    const Fence fence = Fence::insert();
    while (!fence.is_passed()) continue;  // the test's time limit catches a fence that never comes
}

TEST_F(FenceTest, IsPassedWhereThereIsNoMark) {
    Fence from = Fence::insert();
    Fence to;
    EXPECT_TRUE(to.is_passed());
    to = std::move(from);
    EXPECT_TRUE(from.is_passed());
    from.wait();
    to.wait();
    EXPECT_TRUE(to.is_passed());
}

}  // namespace
}  // namespace gelatin::gl
