#include "gpu/descent/limited_sweeps.h"

#include <gtest/gtest.h>

#include "gpu/support/contact_scenarios.h"

namespace gelatin {
namespace {

class LimitedSweepsParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, LimitedSweepsParityTest, ::testing::ValuesIn(test::limited_sweep_scenarios()),
                         test::name_of_scenario);

TEST_P(LimitedSweepsParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

}  // namespace
}  // namespace gelatin
