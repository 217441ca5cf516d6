#include "gpu/collision/respond.h"

#include <gtest/gtest.h>

#include "support/crowd.h"
#include "support/gl_fixture.h"
#include "support/parity.h"

namespace gelatin {
namespace {

constexpr double kStep = 1e-3;     // [s]
constexpr double kLongStep = 0.1;  // on its way a block meets others [s]

class RespondOnGpuTest : public test::GlTest, public ::testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(Objects, RespondOnGpuTest, ::testing::Values(2, 7, 30, 90));

TEST_P(RespondOnGpuTest, MatchesTheDoubleReference) {
    const Model model = test::make_crowd(GetParam(), static_cast<unsigned>(GetParam()));
    for (const CollisionSettings& settings : {CollisionSettings{.friction = 0.0, .restitution = 0.0},
                                              CollisionSettings{.friction = 0.4, .restitution = 0.7}}) {
        const test::NodeArrays actual = test::respond_on_gpu(model, settings, kStep);
        EXPECT_LE(test::worst_response_error(model, settings, kStep, actual), 1.0);
        std::size_t responded = 0;
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            EXPECT_EQ(actual.positions[n].w, model.positions[n].w);
            EXPECT_EQ(actual.velocities[n].w, model.velocities[n].w);
            responded += actual.velocities[n] != model.velocities[n] ? 1 : 0;
        }
        EXPECT_GT(responded, 3u);
        EXPECT_TRUE(test::guard_is_untouched(actual.positions, model.node_count()));
        EXPECT_TRUE(test::guard_is_untouched(actual.velocities, model.node_count()));
    }
}

TEST_P(RespondOnGpuTest, MatchesTheDoubleReferenceOnTheWay) {
    const Model model = test::make_crowd(GetParam(), static_cast<unsigned>(GetParam()));
    const CollisionSettings settings{.detection = CollisionDetection::continuous};
    const test::NodeArrays actual = test::respond_on_gpu(model, settings, kLongStep);
    EXPECT_LE(test::worst_response_error(model, settings, kLongStep, actual), 1.0);
}

// Pinned nodes that handles move push with their velocity.
TEST_P(RespondOnGpuTest, MatchesTheDoubleReferenceWithMovingHandles) {
    Model model = test::make_crowd(GetParam(), static_cast<unsigned>(GetParam()));
    test::move_pinned(model, {1.0f, -2.0f, 0.5f});
    EXPECT_LE(test::worst_response_error(model, {}, kStep, test::respond_on_gpu(model, {}, kStep)), 1.0);
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
