#include "sim/run_clock.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

constexpr double kFrameTime = 1.0 / 60.0;  // [s]

RunClock after_steps(int count) {
    RunClock clock(kFrameTime, 7);
    for (int s = 0; s < count; ++s) clock.count_step();
    return clock;
}

TEST(RunClock, CountsFramesOfSubsteps) {
    const RunClock clock = after_steps(23);
    EXPECT_EQ(clock.step_size(), kFrameTime / 7);
    EXPECT_EQ(clock.now().frame, 3);
    EXPECT_EQ(clock.now().steps, 23u);
    EXPECT_EQ(clock.time(), 23 * (kFrameTime / 7));
    EXPECT_FALSE(clock.is_at_end_of_frame());
    EXPECT_TRUE(after_steps(21).is_at_end_of_frame());
}

// Times that were added up instead would be off in the last bits.
TEST(RunClock, AResumedRunHasTheTimesOfOneThatWasNotInterrupted) {
    const RunClock whole = after_steps(140), before = after_steps(84);
    RunClock resumed(kFrameTime, 7);
    resumed.go_on_from(before.now());
    for (int s = 84; s < 140; ++s) resumed.count_step();
    EXPECT_EQ(resumed.time(), whole.time());
    EXPECT_EQ(resumed.now().frame, whole.now().frame);
    EXPECT_EQ(resumed.now().steps, whole.now().steps);
}

TEST(RunClock, GoesOnFromMomentsOfOtherStepSizes) {
    RunClock clock(kFrameTime, 7);
    clock.go_on_from({5, 5.5 * kFrameTime, 35});
    for (int s = 0; s < 7; ++s) clock.count_step();
    EXPECT_EQ(clock.now().frame, 6);
    EXPECT_EQ(clock.now().steps, 42u);
    EXPECT_DOUBLE_EQ(clock.time(), 6.5 * kFrameTime);
}

}  // namespace
}  // namespace gelatin
