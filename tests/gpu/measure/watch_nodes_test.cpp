#include "gpu/measure/watch_nodes.h"

#include <gtest/gtest.h>

#include "support/gl_fixture.h"
#include "support/test_models.h"
#include "support/watched_runs.h"

namespace gelatin {
namespace {

class WatchNodesOnGpuTest : public test::GlTest {};

TEST_F(WatchNodesOnGpuTest, MatchesTheCpu) {
    const Model model = test::make_lively_model();
    ASSERT_NE(model.node_count() % 64, 0u);
    int alarms = 0;
    for (const test::WatchedRun& run : test::watched_runs(model)) {
        const Alarm actual = test::watch_on_gpu(model, run), expected = test::watch_on_cpu(model, run);
        EXPECT_EQ(actual.step, expected.step);
        EXPECT_EQ(actual.node, expected.node);
        EXPECT_EQ(actual.count, expected.count);
        EXPECT_TRUE(test::agree(actual, expected)) << actual.speed << " " << expected.speed;
        alarms += expected.count > 0 ? 1 : 0;
    }
    EXPECT_EQ(alarms, 7);
}

TEST_F(WatchNodesOnGpuTest, TellsWithoutWaitingAndForgets) {
    const Model model = test::make_lively_model();
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    gpu::WatchNodes watch;
    gl::barrier(gl::Barrier::storage);  // as a step has
    watch.run(buffers, nodes, 3, 0.0);  // nothing may move
    Alarm alarm = kNoAlarm;
    for (int asked = 0; alarm.count == 0 && asked < 1'000'000; ++asked) alarm = watch.alarm(false);
    EXPECT_EQ(alarm.step, 3u);
    watch.forget();
    EXPECT_EQ(watch.alarm(true).count, 0u);
    gl::barrier(gl::Barrier::storage);  // as a step has
    watch.run(buffers, nodes, 8, 0.0);
    EXPECT_EQ(watch.alarm(true).step, 8u);
}

}  // namespace
}  // namespace gelatin
