#include "cpu/collision.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/crowd.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr BroadPhase kBroadPhases[] = {BroadPhase::none, BroadPhase::boxes, BroadPhase::hierarchy};

class CrowdTest : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Objects, CrowdTest, ::testing::Values(2, 3, 7, 30));

TEST_P(CrowdTest, CollidesAsBruteForceSays) {
    const Model model = test::make_crowd(GetParam(), static_cast<unsigned>(GetParam()));
    const test::FaceCollisions expected = test::find_collisions_by_brute_force(model);
    EXPECT_FALSE(expected.empty()) << "the crowd is not dense enough to test anything";
    for (const BroadPhase broad_phase : kBroadPhases) {
        EXPECT_EQ(test::find_collisions_on_cpu<float>(model, broad_phase), expected);
        EXPECT_EQ(test::find_collisions_on_cpu<double>(model, broad_phase), expected);
    }
}

TEST(Collision, IsTheSameForAnyNumberOfThreads) {
    const Model model = test::make_crowd(60, 4);
    const test::FaceCollisions parallel = test::find_collisions_on_cpu<float>(model, BroadPhase::hierarchy);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(test::find_collisions_on_cpu<float>(model, BroadPhase::hierarchy), parallel);
}

// Two blocks of one cell, the second moved by `offset`.
Model make_two_blocks(glm::dvec3 offset) {
    Body first = test::make_body(test::make_block({1, 1, 1}, {1, 1, 1}));
    Body second = first;
    for (glm::dvec3& p : second.mesh.positions) p += offset;
    return pack_bodies({first, second}, {}, {0.0, 0.0, 0.0});
}

TEST(Collision, CountsTouchingFaces) {
    for (const BroadPhase broad_phase : kBroadPhases) {
        EXPECT_FALSE(test::find_collisions_on_cpu<float>(make_two_blocks({1, 0, 0}), broad_phase).empty())
            << "face on face";
        EXPECT_FALSE(test::find_collisions_on_cpu<float>(make_two_blocks({1, 1, 1}), broad_phase).empty())
            << "corner on corner";
        EXPECT_TRUE(
            test::find_collisions_on_cpu<float>(make_two_blocks({1.0001, 0, 0}), broad_phase).empty());
        // Boxes meet, surfaces do not: discrete detection sees surfaces alone.
        EXPECT_TRUE(test::find_collisions_on_cpu<float>(make_two_blocks({0, 0, 3}), broad_phase).empty());
    }
}

TEST(Collision, PairsStandInRowsAndMirrorEachOther) {
    const Model model = test::make_crowd(30, 2);
    cpu::Collision<float> collision(std::make_shared<const Model>(model), BroadPhase::boxes);
    collision.update_boxes(model.positions);
    collision.find_object_pairs();
    const auto& pairs = collision.pairs();
    ASSERT_FALSE(pairs.empty());
    std::size_t seen = 0;
    for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
        const Range row = collision.row(o);
        for (std::uint32_t p = row.first; p < row.end(); ++p, ++seen) {
            EXPECT_EQ(pairs[p].object, o);
            EXPECT_EQ(pairs[pairs[p].mirror].object, pairs[p].other);
            EXPECT_EQ(pairs[pairs[p].mirror].other, o);
            EXPECT_TRUE(p == row.first || pairs[p - 1].other < pairs[p].other);
            EXPECT_TRUE(cpu::meet(collision.bounding_boxes()[o], collision.bounding_boxes()[pairs[p].other]));
        }
    }
    EXPECT_EQ(seen, pairs.size());
}

}  // namespace
}  // namespace gelatin
