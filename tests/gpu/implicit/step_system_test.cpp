// The system of a step on the GPU, solved, against the double reference: bodies that are free, and held.
#include "gpu/implicit/step_system.h"

#include <gtest/gtest.h>

#include "gpu/support/implicit_scenarios.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

class StepSystemParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, StepSystemParityTest,
                         ::testing::ValuesIn(test::joined({test::step_system_scenarios(),
                                                           test::small_island_scenarios(false),
                                                           test::small_island_scenarios(true)})),
                         test::name_of_scenario);

TEST_P(StepSystemParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class StepSystemOnGpuTest : public test::GlTest {};

TEST_F(StepSystemOnGpuTest, RepeatsBitForBit) {
    EXPECT_TRUE(test::solves_repeat());
}

}  // namespace
}  // namespace gelatin
