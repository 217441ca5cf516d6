#include "gpu/measure/watch_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/support/solver_scenarios.h"
#include "gpu/support/watched_runs.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class WatchParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, WatchParityTest, ::testing::ValuesIn(test::watch_scenarios()),
                         test::name_of_scenario);

TEST_P(WatchParityTest, MatchesTheCpu) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class WatchNodesOnGpuTest : public test::GlTest {};

TEST_F(WatchNodesOnGpuTest, HasRunsWithAlarmsAndNodesBeyondTheLastFullGroup) {
    const Model model = test::make_lively_model();
    EXPECT_NE(model.node_count() % 64, 0u);
    const auto runs = test::watched_runs(model);
    EXPECT_EQ(std::count_if(runs.begin(), runs.end(),
                            [&](const auto& run) { return test::watch_on_cpu(model, run).count > 0; }),
              7);
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
