#include "gpu/proximity/find_proximities.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/collision_stages.h"
#include "gpu/support/collision_scenarios.h"
#include "support/crowd.h"
#include "support/gl_fixture.h"
#include "support/proximities.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class ProximityParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, ProximityParityTest, ::testing::ValuesIn(test::proximity_scenarios()),
                         test::name_of_scenario);

TEST_P(ProximityParityTest, FindsWhatBruteForceFinds) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class FindProximitiesOnGpuTest : public test::GlTest,
                                 public ::testing::WithParamInterface<test::ProximityScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, FindProximitiesOnGpuTest, ::testing::ValuesIn(test::kProximityScenes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(FindProximitiesOnGpuTest, RepeatsBitForBitByAnyBroadPhase) {
    const Model model = GetParam().make();
    CollisionSettings settings{.self_collision = true, .proximity_radius = GetParam().radius};
    const test::FoundProximities expected = test::find_proximities_on_gpu(model, settings);
    for (const BroadPhase broad_phase : {BroadPhase::hierarchy, BroadPhase::none, BroadPhase::boxes}) {
        settings.broad_phase = broad_phase;
        EXPECT_EQ(test::find_proximities_on_gpu(model, settings), expected);
    }
}

using FindProximitiesOnGpu = test::GlTest;

// What does not fit is counted; the rest is as it was, and in its place.
TEST_F(FindProximitiesOnGpu, CountsWhatDoesNotFit) {
    const Model model = test::make_crowd(20);
    const CollisionSettings settings{.self_collision = true, .proximity_radius = 0.05};
    const test::FoundOnGpu all = test::find_proximities_on_gpu(model, settings);
    const std::size_t count = all.proximities.size();
    EXPECT_NE((all.starts.size() - 1) % 64, 0u);
    for (const std::size_t capacity : {count, count - 1, count / 2, std::size_t{1}}) {
        const test::FoundOnGpu some = test::find_proximities_on_gpu(model, settings, capacity);
        EXPECT_EQ(some.starts, all.starts);
        EXPECT_EQ(some.measure.lost, count - capacity);
        EXPECT_EQ(some.measure.nearest, all.measure.nearest);
        ASSERT_EQ(some.proximities.size(), capacity);
        EXPECT_TRUE(std::equal(some.proximities.begin(), some.proximities.end(), all.proximities.begin()));
    }
}

// All is near to all, which no list has room for: said so, and nothing wrong found.
TEST_F(FindProximitiesOnGpu, SaysWhatIsNotTested) {
    const Model model = pack_bodies({test::make_body(test::make_block({20, 20, 20}, {1, 1, 1})),
                                     test::make_body(test::make_block({20, 20, 20}, {1, 1, 1}))},
                                    {}, {0.0, 0.0, 0.0});
    const CollisionSettings settings{.proximity_radius = 10.0};
    const test::FoundOnGpu found = test::find_proximities_on_gpu(model, settings);
    EXPECT_GT(found.lost_pairs, 0u);
    EXPECT_GT(found.measure.lost, 0u);
    EXPECT_TRUE(std::is_sorted(found.starts.begin(), found.starts.end()));
    const std::size_t nodes = model.surface_parts.nodes.size();
    for (std::size_t query = 0; query < nodes; ++query) {
        const std::uint32_t node = model.surface_parts.nodes[query];
        for (std::size_t k = found.starts[query]; k < found.starts[query + 1]; ++k) {
            if (k >= found.proximities.size()) break;
            ASSERT_EQ(found.proximities[k].first, node);
            ASSERT_LT(found.proximities[k].second, model.faces.size());
        }
    }
}

TEST_F(FindProximitiesOnGpu, BoxesWithAMarginAreThoseOfTheCpu) {
    const Model model = test::make_crowd(30);
    const CollisionSettings settings{.proximity_radius = 0.03};
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    const gpu::Collision stages(model, settings);
    stages.update_boxes.run(model_buffers, stages.buffers, nodes, nodes);
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<Box> boxes(model.faces.size());
    stages.buffers.face_boxes.download(boxes);
    cpu::Collision<float> expected(std::make_shared<const Model>(model), BroadPhase::hierarchy,
                                   CollisionDetection::discrete, cpu::BoxMargin<float>::for_distance(0.03));
    expected.update_boxes(model.positions);
    for (std::size_t f = 0; f < boxes.size(); ++f) {
        EXPECT_EQ(glm::vec3(boxes[f].min), expected.face_boxes()[f].min);
        EXPECT_EQ(glm::vec3(boxes[f].max), expected.face_boxes()[f].max);
    }
}

TEST_F(FindProximitiesOnGpu, LeavesFaceCollisionsAsTheyAre) {
    const Model model = test::make_crowd(30);
    EXPECT_EQ(test::find_collisions_on_gpu(model, {.proximity_radius = 0.1}),
              test::find_collisions_on_gpu(model, {}));
}

class FindProximitiesOnGpuHeavy : public test::GlTest, public ::testing::WithParamInterface<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, FindProximitiesOnGpuHeavy, ::testing::Range(1u, 4u));

TEST_P(FindProximitiesOnGpuHeavy, FindsWhatBruteForceFinds) {
    const Model model = test::make_crowd(100, GetParam());
    for (const double radius : {1e-4, 0.01, 0.05}) {
        const CollisionSettings settings{.self_collision = true, .proximity_radius = radius};
        const test::FoundOnGpu found = test::find_proximities_on_gpu(model, settings, 1u << 20);
        ASSERT_EQ(found.lost_pairs + found.measure.lost, 0u);
        const auto errors = test::check_proximities<float>(model, settings, found);
        test::expect_none(errors);
        EXPECT_GT(errors.compared, 10'000'000u);
    }
}

}  // namespace
}  // namespace gelatin
