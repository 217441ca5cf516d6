#include "gpu/drive/apply_kinematics.h"

#include <gtest/gtest.h>

#include "support/drive_on_gpu.h"
#include "support/gl_fixture.h"
#include "support/parity.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class ApplyKinematicsOnGpuTest : public test::GlTest {};

// Before, between and after keyframes, and once one of the two handles is released.
TEST_F(ApplyKinematicsOnGpuTest, MatchesTheDoubleReference) {
    const Model model = test::make_driven_model();
    ASSERT_NE(model.handle_nodes.size() % 64, 0u);
    ASSERT_EQ(model.handles.size(), 2u);
    for (const double time : {0.0, 0.3, 0.49, 0.9, 1.1, 5.0}) {
        const auto motions = handle_motions(model.handles, time, 1.0 / 60.0);
        EXPECT_EQ(motions[1].center.w, time < 1.0 ? 1.0f : 0.0f);
        const test::NodeArrays actual = test::apply_kinematics_on_gpu(model, motions);
        EXPECT_LE(test::worst_kinematics_error(model, motions, actual), 1.0) << time;
        EXPECT_TRUE(test::guard_is_untouched(actual.positions, model.node_count()));
        EXPECT_TRUE(test::guard_is_untouched(actual.velocities, model.node_count()));
    }
}

}  // namespace
}  // namespace gelatin
