// The guard of pairs on the GPU against the double reference, and whether surfaces keep apart.
#include "gpu/implicit/pair_guard.h"

#include <gtest/gtest.h>

#include "gpu/support/pair_guard_scenarios.h"

namespace gelatin {
namespace {

class PairGuardParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, PairGuardParityTest, ::testing::ValuesIn(test::pair_guard_scenarios()),
                         test::name_of_scenario);

TEST_P(PairGuardParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

}  // namespace
}  // namespace gelatin
