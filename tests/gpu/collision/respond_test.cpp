#include "gpu/collision/respond.h"

#include <gtest/gtest.h>

#include "gpu/support/collision_scenarios.h"
#include "support/crowd.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

constexpr double kStep = 1e-3;  // [s]

class ResponseParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, ResponseParityTest, ::testing::ValuesIn(test::response_scenarios()),
                         test::name_of_scenario);

TEST_P(ResponseParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class RespondOnGpuTest : public test::GlTest, public ::testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(Objects, RespondOnGpuTest, ::testing::Values(2, 7, 30, 90));

TEST_P(RespondOnGpuTest, ChangesVelocities) {
    const Model model = test::make_crowd(GetParam(), static_cast<unsigned>(GetParam()));
    const test::NodeArrays actual = test::respond_on_gpu(model, {}, kStep);
    std::size_t responded = 0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        responded += actual.velocities[n] != model.velocities[n] ? 1 : 0;
    EXPECT_GT(responded, 3u);
}

TEST_P(RespondOnGpuTest, RepeatsBitForBit) {
    const Model model = test::make_crowd(GetParam(), 9);
    const test::NodeArrays one = test::respond_on_gpu(model, {}, kStep),
                           two = test::respond_on_gpu(model, {}, kStep);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        EXPECT_EQ(one.positions[n], two.positions[n]);
        EXPECT_EQ(one.velocities[n], two.velocities[n]);
    }
}

}  // namespace
}  // namespace gelatin
