// Rows of near pairs on the GPU, islands of bodies and tables, against the double reference and the host's
// tables.
#include "gpu/implicit/pair_rows.h"

#include <gtest/gtest.h>

#include "gpu/support/pair_rows_scenarios.h"

namespace gelatin {
namespace {

class PairRowsParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, PairRowsParityTest, ::testing::ValuesIn(test::pair_rows_scenarios()),
                         test::name_of_scenario);

TEST_P(PairRowsParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

}  // namespace
}  // namespace gelatin
