#include "gpu/descent/block_descent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cpu/descent/block_descent.h"
#include "support/descend_on_gpu.h"
#include "support/gl_fixture.h"
#include "support/parity.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class BlockDescentOnGpuTest : public test::GlTest {};

TEST_F(BlockDescentOnGpuTest, MatchesTheDoubleReference) {
    for (const double damping : {0.0, 0.01}) {
        const Model model = test::make_bodies_to_descend(damping);
        ASSERT_NE(model.node_count() % 64, 0u);
        for (const double step : {1e-3, 1.0 / 60.0}) {
            for (const int iterations : {1, 2, 3, 10}) {
                const test::Descent descent{step, {iterations}};
                const test::NodeArrays actual = test::descend_on_gpu(model, descent);
                EXPECT_LE(test::worst_descent_error(model, descent, actual), 1.0)
                    << damping << " s, " << step << " s, " << iterations << " sweeps";
                EXPECT_TRUE(test::guard_is_untouched(actual.positions, model.node_count()));
                EXPECT_TRUE(test::guard_is_untouched(actual.velocities, model.node_count()));
            }
        }
    }
}

TEST_F(BlockDescentOnGpuTest, MatchesTheDoubleReferenceWithLoadsAndHandles) {
    for (const double poisson_ratio : {0.25, 0.4}) {
        const Model model =
            test::make_bodies_to_descend(0.01, poisson_ratio, MaterialModel::mass_spring, true);
        ASSERT_FALSE(model.loads.empty() || model.handles.empty());
        for (const double step : {1e-3, 1.0 / 60.0}) {
            const test::Descent descent{step, {3}};
            EXPECT_LE(test::worst_descent_error(model, descent, test::descend_on_gpu(model, descent)), 1.0)
                << poisson_ratio << ", " << step << " s";
        }
    }
}

TEST_F(BlockDescentOnGpuTest, KeepsVolumesAsTheDoubleReference) {
    for (const double poisson_ratio : {0.1, 0.4}) {
        const Model model = test::make_bodies_to_descend(0.0, poisson_ratio);
        const test::Descent descent{1.0 / 60.0, {5}};
        const test::NodeArrays actual = test::descend_on_gpu(model, descent);
        EXPECT_LE(test::worst_descent_error(model, descent, actual), 1.0) << poisson_ratio;
    }
}

// Earlier velocities from which some nodes have gained less than nothing, some a part of gravity, some more
// than all.
TEST_F(BlockDescentOnGpuTest, LooksBackAsTheDoubleReference) {
    const Model model = test::make_bodies_to_descend(0.0);
    test::Descent descent{1.0 / 60.0, {1}, model.velocities};
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        descent.earlier_velocities[n].y += 0.1f * static_cast<float>(n % 8) - 0.25f;
    EXPECT_LE(test::worst_descent_error(model, descent, test::descend_on_gpu(model, descent)), 1.0);
}

TEST_F(BlockDescentOnGpuTest, MatchesTheDoubleReferenceOfRotatedBodies) {
    const Model model = test::make_bodies_to_descend(0.01);
    const test::Descent descent{1.0 / 60.0, {3}, {}, test::rotated_start(model)};
    EXPECT_LE(test::worst_descent_error(model, descent, test::descend_on_gpu(model, descent)), 1.0);
}

TEST_F(BlockDescentOnGpuTest, SlidesAsTheDoubleReference) {
    EXPECT_LE(test::sliding_descent_error(), 1.0);
}

TEST_F(BlockDescentOnGpuTest, RepeatsBitForBit) {
    const Model model = test::make_bodies_to_descend(0.0, 0.4);
    const test::Descent descent{1.0 / 60.0, {10}};
    const test::NodeArrays one = test::descend_on_gpu(model, descent),
                           two = test::descend_on_gpu(model, descent);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        EXPECT_EQ(one.positions[n], two.positions[n]);
        EXPECT_EQ(one.velocities[n], two.velocities[n]);
    }
}

// To the last bit: rigid motions of nothing round no position.
TEST_F(BlockDescentOnGpuTest, LeavesBodiesAtRestWhereTheyAre) {
    test::Net net;
    for (int n = 0; n < 13; ++n) {
        const float t = static_cast<float>(n);
        net.positions.emplace_back(0.1f + 0.37f * t, 3.3f / (t + 0.7f), std::sin(t));
        net.velocities.emplace_back(0.0f);
        net.masses.push_back(0.3 + 0.1 * n);
    }
    net.gravity = {0.0, 0.0, 0.0};
    const Model model = test::make_model(net);
    const test::NodeArrays actual = test::descend_on_gpu(model, {1.0 / 60.0, {10}});
    for (std::uint32_t n = 0; n < model.node_count(); ++n) EXPECT_EQ(actual.positions[n], model.positions[n]);
}

TEST_F(BlockDescentOnGpuTest, SurvivesDegenerateSprings) {
    for (const int iterations : {1, 5})
        EXPECT_LE(test::degenerate_descent_error(iterations), 1.0) << iterations;
}

}  // namespace
}  // namespace gelatin
