#include "gl/timer.h"

#include <gmock/gmock.h>

#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "support/gl_fixture.h"
#include "support/shader_folder.h"

namespace gelatin::gl {
namespace {

using ::testing::Each;
using ::testing::Gt;

class TimerTest : public test::GlTest {};

TEST_F(TimerTest, ComputeTakesTime) {
    test::ShaderFolder folder;
    folder.add("work.comp", R"(
        layout(local_size_x = 64) in;
        layout(std430) buffer Out { float values[]; };
        void main() {
            float x = float(gl_GlobalInvocationID.x);
            for (int i = 0; i < 1000; ++i) x = sin(x) + 1.0;
            values[gl_GlobalInvocationID.x] = x;
        })");
    const Program program = Program::compute("work.comp");
    const Buffer<float> buffer(6400);
    program.bind("Out", buffer);

    TimestampStageTimer timer;
    for (int i = 0; i < 20; ++i) {
        timer.begin("work");
        program.dispatch(6400);
        barrier(Barrier::storage);
        timer.end();
    }
    timer.begin("other");
    timer.end();
    timer.finish();
    const StageTimes times = timer.take();
    ASSERT_EQ(times.size(), 2u);
    ASSERT_EQ(times.at("work").size(), 20u);
    EXPECT_THAT(times.at("work"), Each(Gt(0.0)));
    EXPECT_EQ(times.at("other").size(), 1u);
    EXPECT_TRUE(timer.take().empty()) << "take gives each measurement once";
}

// And stages that are taken while others are under way do not confuse which one ends.
TEST_F(TimerTest, TimesStagesWithinStages) {
    TimestampStageTimer timer;
    for (int i = 0; i < 2; ++i) {
        timer.begin("step");
        for (int k = 0; k < 3; ++k) {
            timer.begin("step.sweep");
            timer.end();
        }
        timer.end();
        timer.begin("other");
        timer.finish();
        const StageTimes times = timer.take();
        EXPECT_EQ(times.at("step").size(), 1u);
        EXPECT_EQ(times.at("step.sweep").size(), 3u);
        EXPECT_GE(times.at("step")[0],
                  times.at("step.sweep")[0] + times.at("step.sweep")[1] + times.at("step.sweep")[2]);
        EXPECT_EQ(times.count("other"), i == 0 ? 0u : 1u);
        timer.end();
    }
}

TEST_F(TimerTest, AnOpenStageIsNotTaken) {
    TimestampStageTimer timer;
    timer.begin("open");
    timer.finish();
    EXPECT_TRUE(timer.take().empty());
    timer.end();
    timer.finish();
    EXPECT_EQ(timer.take().count("open"), 1u);
}

}  // namespace
}  // namespace gelatin::gl
