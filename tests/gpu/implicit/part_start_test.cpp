// Where a part of a step begins on the GPU: rows of colliders, schemes, targets and decisions, against the
// double reference.
#include "gpu/implicit/part_start.h"

#include <gtest/gtest.h>

#include "gpu/support/part_start_scenarios.h"

namespace gelatin {
namespace {

class PartStartParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, PartStartParityTest, ::testing::ValuesIn(test::part_start_scenarios()),
                         test::name_of_scenario);

TEST_P(PartStartParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

}  // namespace
}  // namespace gelatin
