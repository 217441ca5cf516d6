#include <gtest/gtest.h>

#include "gpu/support/solver_scenarios.h"

namespace gelatin {
namespace {

class PullParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, PullParityTest, ::testing::ValuesIn(test::pull_scenarios()),
                         test::name_of_scenario);

TEST_P(PullParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

}  // namespace
}  // namespace gelatin
