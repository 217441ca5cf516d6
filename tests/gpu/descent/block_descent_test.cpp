#include "gpu/descent/block_descent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cpu/descent/block_descent.h"
#include "gpu/support/solver_scenarios.h"
#include "support/descend_on_gpu.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class BlockDescentParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, BlockDescentParityTest, ::testing::ValuesIn(test::descent_scenarios()),
                         test::name_of_scenario);

TEST_P(BlockDescentParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class DrivenDescentParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, DrivenDescentParityTest, ::testing::ValuesIn(test::driven_descent_scenarios()),
                         test::name_of_scenario);

TEST_P(DrivenDescentParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class BlockDescentOnGpuTest : public test::GlTest {};

TEST_F(BlockDescentOnGpuTest, HasNodesBeyondTheLastFullGroup) {
    EXPECT_NE(test::make_bodies_to_descend(0.0).node_count() % 64, 0u);
}

TEST_F(BlockDescentOnGpuTest, RepeatsBitForBit) {
    const Model model = test::make_bodies_to_descend(0.0, 0.4);
    const test::Descent descent{1.0 / 60.0, {10}};
    const test::NodeArrays one = test::descend_on_gpu(model, descent),
                           two = test::descend_on_gpu(model, descent);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        EXPECT_EQ(one.positions[n], two.positions[n]);
        EXPECT_EQ(one.velocities[n], two.velocities[n]);
    }
}

// To the last bit: rigid motions of nothing round no position.
TEST_F(BlockDescentOnGpuTest, LeavesBodiesAtRestWhereTheyAre) {
    test::Net net;
    for (int n = 0; n < 13; ++n) {
        const float t = static_cast<float>(n);
        net.positions.emplace_back(0.1f + 0.37f * t, 3.3f / (t + 0.7f), std::sin(t));
        net.velocities.emplace_back(0.0f);
        net.masses.push_back(0.3 + 0.1 * n);
    }
    net.gravity = {0.0, 0.0, 0.0};
    const Model model = test::make_model(net);
    const test::NodeArrays actual = test::descend_on_gpu(model, {1.0 / 60.0, {10}});
    for (std::uint32_t n = 0; n < model.node_count(); ++n) EXPECT_EQ(actual.positions[n], model.positions[n]);
}

}  // namespace
}  // namespace gelatin
