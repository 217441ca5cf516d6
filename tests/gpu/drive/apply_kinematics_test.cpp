#include "gpu/drive/apply_kinematics.h"

#include <gtest/gtest.h>

#include "gpu/support/solver_scenarios.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class KinematicsParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, KinematicsParityTest, ::testing::ValuesIn(test::kinematics_scenarios()),
                         test::name_of_scenario);

TEST_P(KinematicsParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

TEST(ApplyKinematics, HasHandlesBeforeAndAfterTheirRelease) {
    const Model model = test::make_driven_model();
    ASSERT_NE(model.handle_nodes.size() % 64, 0u);
    ASSERT_EQ(model.handles.size(), 2u);
    EXPECT_EQ(handle_motions(model.handles, 0.9, 1.0 / 60.0)[1].center.w, 1.0f);
    EXPECT_EQ(handle_motions(model.handles, 1.1, 1.0 / 60.0)[1].center.w, 0.0f);
}

}  // namespace
}  // namespace gelatin
