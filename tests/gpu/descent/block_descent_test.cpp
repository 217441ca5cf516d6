#include "gpu/descent/block_descent.h"

#include <gtest/gtest.h>

#include "cpu/descent/block_descent.h"
#include "support/descend_on_gpu.h"
#include "support/gl_fixture.h"
#include "support/solver_scenarios.h"
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
    const test::Descent descent{1.0 / 60.0, {10, 0.7}};
    const test::NodeArrays one = test::descend_on_gpu(model, descent),
                           two = test::descend_on_gpu(model, descent);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        EXPECT_EQ(one.positions[n], two.positions[n]);
        EXPECT_EQ(one.velocities[n], two.velocities[n]);
    }
}

}  // namespace
}  // namespace gelatin
