#include "cpu/proximity/find_proximities.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "support/crowd.h"
#include "support/proximities.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class FindProximitiesTest : public ::testing::TestWithParam<test::ProximityScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, FindProximitiesTest, ::testing::ValuesIn(test::kProximityScenes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(FindProximitiesTest, FindsWhatBruteForceFinds) {
    const Model model = GetParam().make();
    for (const bool own : {true, false}) {
        const CollisionSettings settings{.self_collision = own, .proximity_radius = GetParam().radius};
        const auto errors = test::check_proximities<float>(
            model, settings, test::find_proximities_on_cpu<float>(model, settings));
        test::expect_none(errors);
        EXPECT_GT(errors.compared, 10'000u);
        if (own) {
            EXPECT_GT(errors.expected, 50u);
        }
        test::expect_none(test::check_proximities<double>(
            model, settings, test::find_proximities_on_cpu<double>(model, settings)));
    }
}

TEST_P(FindProximitiesTest, FindsTheSameByAnyBroadPhase) {
    const Model model = GetParam().make();
    CollisionSettings settings{.self_collision = true, .proximity_radius = GetParam().radius};
    const auto expected = test::find_proximities_on_cpu<float>(model, settings);
    for (const BroadPhase broad_phase : {BroadPhase::none, BroadPhase::boxes}) {
        settings.broad_phase = broad_phase;
        EXPECT_EQ(test::find_proximities_on_cpu<float>(model, settings), expected);
    }
}

TEST(FindProximities, GivesTheSameBitsForAnyNumberOfThreads) {
    const Model model = test::make_crowd(30);
    const CollisionSettings settings{.self_collision = true, .proximity_radius = 0.05};
    const auto many = test::find_proximities_on_cpu<float>(model, settings);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(test::find_proximities_on_cpu<float>(model, settings), many);
}

// Two unit cubes 1/4 m apart along x: only the sides that face one another, by numbers that can be counted.
TEST(FindProximities, OfTwoCubes) {
    std::vector<Body> bodies(2, test::make_body(test::make_block({1, 1, 1}, {1, 1, 1})));
    for (glm::dvec3& p : bodies[1].mesh.positions) p.x += 1.25;
    const Model model = pack_bodies(bodies, {}, {0.0, 0.0, 0.0});
    const CollisionSettings settings{.proximity_radius = 0.26};
    const test::FoundProximities found = test::find_proximities_on_cpu<double>(model, settings);
    const std::uint32_t node_face = found.starts[model.surface_parts.nodes.size()];
    ASSERT_GT(node_face, 0u);
    for (std::uint32_t k = 0; k < found.proximities.size(); ++k) {
        const cpu::Proximity<double>& p = found.proximities[k];
        EXPECT_EQ(p.distance, 0.25);
        const bool of_first = k < node_face ? p.first < model.objects[1].nodes.first
                                            : model.surface_parts.edges[p.first].object == 0;
        EXPECT_EQ(p.apart, glm::dvec3(of_first ? 0.25 : -0.25, 0.0, 0.0));
    }
    EXPECT_EQ(test::find_proximities_on_cpu<double>(model, {.proximity_radius = 0.25}).proximities.size(), 0u)
        << "nearer than the radius, not as near";
}

TEST(FindProximities, BearsWhatIsNotANumber) {
    Model model = test::make_crowd(4);
    const std::uint32_t broken = model.faces[5].a;
    model.positions[broken].y = NAN;
    const CollisionSettings settings{.self_collision = true, .proximity_radius = 0.05};
    const auto found = test::find_proximities_on_cpu<float>(model, settings);
    EXPECT_GT(found.proximities.size(), 0u);
    for (const cpu::Proximity<double>& p : found.proximities) EXPECT_TRUE(std::isfinite(p.distance));
}

// The faces that touch are the same in boxes with a margin.
TEST(FindProximities, LeavesFaceCollisionsAsTheyAre) {
    const auto model = std::make_shared<const Model>(test::make_crowd(30));
    cpu::Collision<float> collision(model), wide(model, BroadPhase::hierarchy, CollisionDetection::discrete,
                                                 cpu::BoxMargin<float>::for_distance(0.1));
    for (cpu::Collision<float>* stage : {&collision, &wide}) {
        stage->update_boxes(model->positions);
        stage->find_object_pairs();
        stage->find_face_collisions(model->positions);
    }
    EXPECT_GT(wide.pairs().size(), collision.pairs().size());
    for (std::uint32_t f = 0; f < model->faces.size(); ++f)
        EXPECT_EQ(wide.collides(f), collision.collides(f));
}

class FindProximitiesHeavy : public ::testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, FindProximitiesHeavy, ::testing::Range(1u, 5u));

TEST_P(FindProximitiesHeavy, FindsWhatBruteForceFinds) {
    const Model model = test::make_crowd(100, GetParam());
    for (const double radius : {1e-4, 0.01, 0.1}) {
        const CollisionSettings settings{.self_collision = true, .proximity_radius = radius};
        const auto errors = test::check_proximities<float>(
            model, settings, test::find_proximities_on_cpu<float>(model, settings));
        test::expect_none(errors);
        EXPECT_GT(errors.compared, 10'000'000u);
    }
}

}  // namespace
}  // namespace gelatin
