#include "model/drive/handle_clocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/drive/handles.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using ::testing::ElementsAre;

constexpr double kClockStep = 0.125;  // a power of 2: sums are exact

Handle moving(bool stops, double end) {
    Handle handle;
    handle.keyframes = {{0.0}, {end, {1.0, 0.0, 0.0}}};
    handle.stops = stops;
    return handle;
}

std::shared_ptr<const Model> with(std::vector<Handle> handles) {
    Model model;
    model.handles = std::move(handles);
    return std::make_shared<const Model>(std::move(model));
}

const std::vector<std::uint32_t> kBoth{0, 1}, kNone;

TEST(HandleClocks, AreTheSimulationsWhileNothingIsHeldUp) {
    HandleClocks clocks(with({moving(true, 4.0), moving(false, 4.0)}));
    const HandleTimes times = clocks.advance(1.0, kClockStep);
    EXPECT_THAT(times.begin, ElementsAre(1.0, 1.0));
    EXPECT_THAT(times.end, ElementsAre(1.125, 1.125));
    EXPECT_THAT(clocks.delays(), ElementsAre(0.0, 0.0));
}

// Only those that stop, only while they are blocked; each step begins at the times where the last one ended.
TEST(HandleClocks, StandStill) {
    HandleClocks clocks(with({moving(true, 4.0), moving(false, 4.0)}));
    HandleTimes last = clocks.advance(0.0, kClockStep);
    double time = kClockStep;
    for (int s = 1; s < 12; ++s, time += kClockStep) {
        const bool is_held_up = s >= 3 && s < 8;
        clocks.set_held_up(is_held_up ? kBoth : kNone);
        const HandleTimes times = clocks.advance(time, kClockStep);
        EXPECT_EQ(times.begin, last.end) << s;
        EXPECT_EQ(times.end[0] - times.begin[0], is_held_up ? 0.0 : kClockStep) << s;
        EXPECT_EQ(times.end[1] - times.begin[1], kClockStep) << s;
        last = times;
    }
    EXPECT_THAT(clocks.delays(), ElementsAre(5 * kClockStep, 0.0));
    EXPECT_THAT(clocks.times(time), ElementsAre(time - 5 * kClockStep, time));
}

TEST(HandleClocks, OneDoesNotStopAnother) {
    HandleClocks clocks(with({moving(true, 4.0), moving(true, 4.0)}));
    clocks.set_held_up(std::vector<std::uint32_t>{1});
    clocks.advance(0.5, kClockStep);
    EXPECT_THAT(clocks.delays(), ElementsAre(0.0, kClockStep));
}

// What has done all that it does is not late. A release is still to be done.
TEST(HandleClocks, GoOnWhenNothingIsLeftToDo) {
    Handle released = moving(true, 1.0);
    released.release = 1.25;
    HandleClocks clocks(with({moving(true, 1.0), released}));
    clocks.set_held_up(kBoth);
    clocks.advance(1.0, kClockStep);
    EXPECT_THAT(clocks.delays(), ElementsAre(0.0, kClockStep));
    clocks.set_held_up(kNone);
    clocks.advance(1.5, kClockStep);
    clocks.set_held_up(kBoth);
    clocks.advance(1.625, kClockStep);
    EXPECT_THAT(clocks.delays(), ElementsAre(0.0, kClockStep)) << "it has been released";
}

TEST(HandleClocks, ActWhenTheyAreLate) {
    HandleClocks clocks(with({moving(true, 1.0)}));
    EXPECT_FALSE(clocks.late_ones_act({{0.5}, {0.625}}, kClockStep)) << "as the scene says";
    clocks.go_on_with({2.0});
    EXPECT_TRUE(clocks.late_ones_act(clocks.advance(2.5, kClockStep), kClockStep));
    EXPECT_FALSE(clocks.late_ones_act(clocks.advance(3.5, kClockStep), kClockStep));
}

TEST(HandleClocks, RestartAndGoOn) {
    HandleClocks clocks(with({moving(true, 4.0)}));
    clocks.set_held_up(std::vector<std::uint32_t>{0});
    clocks.advance(0.5, kClockStep);
    clocks.restart();
    EXPECT_THAT(clocks.delays(), ElementsAre(0.0));
    EXPECT_THAT(clocks.advance(0.0, kClockStep).end, ElementsAre(kClockStep)) << "nothing holds it up";
    clocks.go_on_with({0.25});
    EXPECT_THAT(clocks.times(1.0), ElementsAre(0.75));
}

}  // namespace
}  // namespace gelatin
