#include "gpu/recovery/match_shapes.h"

#include <gtest/gtest.h>

#include "gpu/node_buffers.h"
#include "gpu/support/solver_scenarios.h"
#include "model/recovery/match_shapes.h"
#include "support/gl_fixture.h"
#include "support/lost_shapes.h"

namespace gelatin {
namespace {

class ShapeMatcherParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, ShapeMatcherParityTest, ::testing::ValuesIn(test::matching_scenarios()),
                         test::name_of_scenario);

TEST_P(ShapeMatcherParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class ShapeMatcherOnGpuTest : public test::GlTest {};

TEST_F(ShapeMatcherOnGpuTest, HasNodesBeyondTheLastFullGroupAndOfTwoChunks) {
    const Model model = test::make_bodies_to_lose();
    EXPECT_NE(model.node_count() % 64, 0u);
    EXPECT_GT(model.objects[0].nodes.count, 256u);
}

TEST_F(ShapeMatcherOnGpuTest, LeavesOthersAsTheyAre) {
    const Model model = test::make_bodies_to_lose();
    const cpu::Nodes<float> before = test::lose_shapes(model, false);
    std::vector<cpu::Nodes<float>> runs = {before};
    test::match_on_gpu(model, runs);
    for (const std::size_t kept : {1, 3}) {
        const Range& nodes = model.objects[kept].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            EXPECT_EQ(runs[0].positions[n], before.positions[n]);
            EXPECT_EQ(runs[0].velocities[n], before.velocities[n]);
        }
    }
}

TEST_F(ShapeMatcherOnGpuTest, WaitsUnlessNodesWereSetFromOutside) {
    const Model model = test::make_bodies_to_lose();
    const cpu::Nodes<float> whole{model.positions, model.velocities}, lost = test::lose_shapes(model, true);
    std::vector<cpu::Nodes<float>> runs = {lost, whole};
    const auto steps = static_cast<std::size_t>(kPatience / test::kElapsed);
    runs.insert(runs.end(), steps + 2, lost);
    test::match_on_gpu(model, runs);
    const auto is_matched = [&](std::size_t run) { return runs[run].positions != lost.positions; };
    EXPECT_TRUE(is_matched(0));
    for (std::size_t k = 0; k + 1 < steps; ++k) EXPECT_FALSE(is_matched(2 + k)) << k;
    EXPECT_TRUE(is_matched(steps + 3));
}

TEST_F(ShapeMatcherOnGpuTest, GoesOnFromACheckpoint) {
    const Model model = test::make_bodies_to_lose();
    const cpu::Nodes<float> lost = test::lose_shapes(model, true);
    const auto matches = [&](gpu::ShapeMatcher& matcher, const cpu::Nodes<float>& nodes, double elapsed) {
        const gpu::NodeBuffers buffers(nodes.positions, nodes.velocities);
        matcher.run(buffers, elapsed);
        std::vector<glm::vec4> positions(nodes.positions.size());
        gl::barrier(gl::Barrier::buffer_update);
        buffers.positions.download(positions);
        return positions != nodes.positions;
    };
    gpu::ShapeMatcher matcher(model), other(model);
    EXPECT_FALSE(matches(matcher, {model.positions, model.velocities}, 0.1));
    EXPECT_FALSE(matches(matcher, lost, 0.4));
    other.set_lost_for(matcher.lost_for());
    EXPECT_FALSE(matches(other, lost, 0.05));
    EXPECT_TRUE(matches(other, lost, 0.1));
}

}  // namespace
}  // namespace gelatin
