#include "gpu/view/carry_skin.h"

#include <gtest/gtest.h>

#include "gpu/support/solver_scenarios.h"

namespace gelatin {
namespace {

class CarrySkinParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, CarrySkinParityTest, ::testing::ValuesIn(test::carry_skin_scenarios()),
                         test::name_of_scenario);

TEST_P(CarrySkinParityTest, MatchesBarycentricCoordinatesInDouble) {
    EXPECT_LE(GetParam().error(), 1.0);
}

}  // namespace
}  // namespace gelatin
