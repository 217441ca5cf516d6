// The end of a part of an implicit step on the GPU against the double reference: nodes, energies, decisions.
#include "gpu/implicit/part_end.h"

#include <gtest/gtest.h>

#include "gpu/support/part_end_scenarios.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

class PartEndParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, PartEndParityTest, ::testing::ValuesIn(test::part_end_scenarios()),
                         test::name_of_scenario);

TEST_P(PartEndParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class PartEndOnGpuTest : public test::GlTest {};

TEST_F(PartEndOnGpuTest, RepeatsBitForBit) {
    EXPECT_TRUE(test::ends_repeat());
}

}  // namespace
}  // namespace gelatin
