#include "core/stage_timer.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

TEST(HostStageTimer, TimesStagesWithinStages) {
    HostStageTimer timer;
    timer.begin("step");
    for (int i = 0; i < 3; ++i) {
        timer.begin("step.sweep");
        timer.end();
    }
    timer.end();
    const StageTimes times = timer.take();
    ASSERT_EQ(times.size(), 2u);
    ASSERT_EQ(times.at("step.sweep").size(), 3u);
    ASSERT_EQ(times.at("step").size(), 1u);
    double sweeps = 0.0;
    for (const double time : times.at("step.sweep")) sweeps += time;
    EXPECT_GE(times.at("step")[0], sweeps);
    EXPECT_TRUE(timer.take().empty());
}

TEST(HostStageTimer, TimesPartsWhereAskedTo) {
    HostStageTimer timer;
    EXPECT_EQ(timer.for_parts(), nullptr);
    { const TimedStage nothing(timer.for_parts(), "part"); }
    EXPECT_TRUE(timer.take().empty());
    timer.time_parts(true);
    { const TimedStage part(timer.for_parts(), "part"); }
    EXPECT_EQ(timer.take().count("part"), 1u);
}

}  // namespace
}  // namespace gelatin
