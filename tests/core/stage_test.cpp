#include "core/stage.h"

#include <gtest/gtest.h>

#include <string_view>

namespace gelatin {
namespace {

TEST(Stage, IsNamedWhileItLivesAndTimedWhereStagesAre) {
    HostStageTimer timer;
    for (const bool is_timed : {false, true}) {
        timer.time_stages(is_timed);
        {
            const Stage outer(timer, "outer");
            { const Stage inner(timer, "inner"); }
            EXPECT_EQ(std::string_view(CurrentStage::name()), "outer");
        }
        EXPECT_EQ(std::string_view(CurrentStage::name()), "");
        const StageTimes times = timer.take();
        EXPECT_EQ(times.count("outer") + times.count("inner"), is_timed ? 2u : 0u);
    }
}

}  // namespace
}  // namespace gelatin
