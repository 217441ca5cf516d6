// The elements of a step on the GPU: forces, stiffness and its diagonal against the double reference, where
// tets are flat or inside out, too.
#include "gpu/implicit/elastic_system.h"

#include <gtest/gtest.h>

#include "gpu/support/implicit_scenarios.h"
#include "support/elastic_cases.h"

namespace gelatin {
namespace {

class ElasticSystemParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, ElasticSystemParityTest, ::testing::ValuesIn(test::elastic_system_scenarios()),
                         test::name_of_scenario);

TEST_P(ElasticSystemParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

TEST(ElasticSystemOnGpu, HasNodesBeyondTheLastFullGroup) {
    for (const test::ElasticCase& at : test::elastic_cases()) EXPECT_NE(at.model.node_count() % 64, 0u);
}

}  // namespace
}  // namespace gelatin
