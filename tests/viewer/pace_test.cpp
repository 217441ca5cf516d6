#include "viewer/pace.h"

#include <gtest/gtest.h>

namespace gelatin::viewer {
namespace {

// Steps over pictures of 1/60 s, each picture taking what its steps cost, but never less than that.
int run(Pace& pace, int pictures, double cost) {
    int steps = 0;
    double elapsed = 1.0 / 60.0;
    for (int i = 0; i < pictures; ++i) {
        const int made = pace.steps_for(elapsed);
        steps += made;
        if (made > 0) pace.note_cost(cost);
        elapsed = std::max(1.0 / 60.0, made * cost);
    }
    return steps;
}

TEST(Pace, FollowsRealTime) {
    Pace pace(1e-3);
    pace.note_cost(1e-5);
    EXPECT_NEAR(run(pace, 600, 1e-5), 10000, 1);
    EXPECT_FALSE(pace.is_behind());
    EXPECT_NEAR(pace.achieved_speed(), 1.0, 0.05);
}

TEST(Pace, SlowMotionMakesFewerSteps) {
    Pace pace(1e-3);
    pace.note_cost(1e-5);
    pace.set_speed(0.125);
    EXPECT_NEAR(run(pace, 600, 1e-5), 1250, 1);
    EXPECT_FALSE(pace.is_behind());
}

TEST(Pace, StepsLongerThanAPictureComeInTheirTurn) {
    Pace pace(0.05);
    pace.note_cost(1e-3);
    int longest_wait = 0, wait = 0;
    for (int i = 0; i < 300; ++i) {
        wait = pace.steps_for(1.0 / 60.0) > 0 ? 0 : wait + 1;
        longest_wait = std::max(longest_wait, wait);
    }
    EXPECT_EQ(longest_wait, 2);
}

// Three times slower than real time: the motion is, the pictures are not, and nothing is made up for later.
TEST(Pace, SlowStepsSlowTheMotionNotThePictures) {
    Pace pace(1e-3);
    pace.note_cost(3e-3);
    for (int i = 0; i < 300; ++i) EXPECT_LE(pace.steps_for(1.0 / 30.0), 11);
    EXPECT_TRUE(pace.is_behind());
    EXPECT_NEAR(pace.achieved_speed(), 11e-3 * 30.0, 0.05);
    // Once steps are fast again, it is real time at once, not more.
    for (int i = 0; i < 40; ++i) pace.note_cost(1e-6);
    int steps = 0;
    for (int i = 0; i < 60; ++i) steps += pace.steps_for(1.0 / 60.0);
    EXPECT_NEAR(steps, 1000, 1);
}

TEST(Pace, AStepThatTakesSecondsIsStillMade) {
    Pace pace(1.0 / 60.0);
    pace.note_cost(2.0);
    EXPECT_EQ(pace.steps_for(2.0), 1);
    EXPECT_EQ(pace.steps_for(2.0), 1);
}

// A whole frame that is asked for while paused must not block the window either.
TEST(Pace, ManyStepsAreMadeInParts) {
    Pace pace(1.0 / 60.0);
    EXPECT_EQ(pace.most_steps(), 1) << "nothing is known yet";
    pace.note_cost(0.01);
    EXPECT_EQ(pace.most_steps(), 3);
    Pace slow(1.0 / 60.0);
    slow.note_cost(2.0);
    EXPECT_EQ(slow.most_steps(), 1);
}

TEST(Pace, AWindowThatWasHeldUpDoesNotMakeUpForIt) {
    Pace pace(1e-3);
    pace.note_cost(1e-6);
    EXPECT_LE(pace.steps_for(60.0), 100);
    EXPECT_LE(pace.steps_for(0.01), 11);
}

TEST(Pace, NothingIsDueAfterAPause) {
    Pace pace(0.1);
    EXPECT_EQ(pace.steps_for(0.09), 0);
    pace.restart();
    EXPECT_EQ(pace.steps_for(0.09), 0);
    EXPECT_EQ(pace.steps_for(0.02), 1);
}

}  // namespace
}  // namespace gelatin::viewer
