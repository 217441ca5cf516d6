// Pairs of surfaces that may come near each other in a part of a step, on the GPU, against the double
// reference.
#include "gpu/implicit/find_pairs.h"

#include <gtest/gtest.h>

#include "gpu/support/pair_scenarios.h"

namespace gelatin {
namespace {

class FindPairsParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, FindPairsParityTest, ::testing::ValuesIn(test::pair_scenarios()),
                         test::name_of_scenario);

TEST_P(FindPairsParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class FindPairsOnGpuTest : public test::GlTest {};

TEST_F(FindPairsOnGpuTest, RepeatsBitForBit) {
    EXPECT_TRUE(test::pairs_repeat());
}

}  // namespace
}  // namespace gelatin
