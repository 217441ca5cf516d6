#include "cpu/collision/collision.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "support/crowd.h"
#include "support/moving_pairs.h"
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
        EXPECT_EQ(test::find_collisions_on_cpu<float>(model, {.broad_phase = broad_phase}), expected);
        EXPECT_EQ(test::find_collisions_on_cpu<double>(model, {.broad_phase = broad_phase}), expected);
    }
}

TEST(Collision, IsTheSameForAnyNumberOfThreads) {
    const Model model = test::make_crowd(60, 4);
    const test::FaceCollisions parallel = test::find_collisions_on_cpu<float>(model, {});
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(test::find_collisions_on_cpu<float>(model, {}), parallel);
}

// Two blocks of one cell, the second moved by `offset`.
Model make_two_blocks(glm::dvec3 offset) {
    Body first = test::make_body(test::make_block({1, 1, 1}, {1, 1, 1}));
    Body second = first;
    for (glm::dvec3& p : second.mesh.positions) p += offset;
    return pack_bodies({first, second}, {}, {0.0, 0.0, 0.0});
}

// Continuous detection

constexpr double kStep = 0.1;  // of speeds of some 2 m/s, among blocks of 0.3 m and more [s]

CollisionSettings continuous(BroadPhase broad_phase = BroadPhase::hierarchy) {
    return {.broad_phase = broad_phase, .detection = CollisionDetection::continuous};
}

TEST_P(CrowdTest, ContinuousDetectionIsTheSameByEveryPath) {
    const Model model = test::make_crowd(GetParam(), static_cast<unsigned>(GetParam()));
    const auto discrete = test::find_collisions_on_cpu<float>(model, {}),
               expected = test::find_collisions_on_cpu<double>(model, continuous(BroadPhase::none), kStep);
    EXPECT_GT(expected.size(), discrete.size());
    EXPECT_TRUE(std::includes(expected.begin(), expected.end(), discrete.begin(), discrete.end()));
    for (const BroadPhase broad_phase : kBroadPhases)
        EXPECT_EQ(test::find_collisions_on_cpu<float>(model, continuous(broad_phase), kStep), expected);
}

TEST(Collision, ContinuousDetectionFindsWhatComesNear) {
    const Model model = test::make_crowd(3, 3);
    const std::vector<glm::vec4> before = test::positions_before(model, kStep);
    const auto moving = [&](const Face& face) {
        cpu::Moving<float, 3> result;
        const std::uint32_t corners[] = {face.a, face.b, face.c};
        for (int k = 0; k < 3; ++k) {
            result.start[k] = before[corners[k]];
            result.end[k] = model.positions[corners[k]];
        }
        return result;
    };
    test::FaceCollisions expected;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        for (std::uint32_t g = 0; g < model.faces.size(); ++g) {
            const std::uint32_t other = model.faces[g].object;
            if (other == model.faces[f].object) continue;
            const auto face = moving(model.faces[f]), other_face = moving(model.faces[g]);
            if (!test::comes_near(test::MovingPair<float>{face, other_face}, 1e-9)) continue;
            const bool is_new =
                expected.empty() || expected.back().face != f || expected.back().other != other;
            if (is_new) expected.push_back({f, other, cpu::FaceContact::touches});
            if (cpu::face_contacts(face, other_face).ours == cpu::FaceContact::enters)
                expected.back().touch = cpu::FaceContact::enters;
        }
    }
    EXPECT_EQ(test::find_collisions_on_cpu<float>(model, continuous(), kStep), expected);
}

// In one step it flies through a plate, both a tenth as thick as its displacement.
TEST(Collision, ContinuousDetectionSeesAThinFastBody) {
    Body plate = test::make_body(test::make_block({4, 1, 4}, {1, 0.01, 1}));
    Body bullet = test::make_body(test::make_block({1, 1, 1}, {0.05, 0.01, 0.05}));
    for (glm::dvec3& p : bullet.mesh.positions) p += glm::dvec3(0.4, -0.1, 0.4);
    bullet.velocity = {0.0, -200.0, 0.0};
    const Model model = pack_bodies({plate, bullet}, {}, {0.0, 0.0, 0.0});
    for (const BroadPhase broad_phase : kBroadPhases) {
        const CollisionSettings discrete{.broad_phase = broad_phase};
        EXPECT_TRUE(test::find_collisions_on_cpu<float>(model, discrete, 1e-3).empty());
        EXPECT_FALSE(test::find_collisions_on_cpu<float>(model, continuous(broad_phase), 1e-3).empty());
    }
    EXPECT_TRUE(test::find_collisions_on_cpu<float>(model, continuous(), 1e-4).empty())
        << "behind it already";
}

TEST(Collision, CountsTouchingFaces) {
    for (const BroadPhase broad_phase : kBroadPhases) {
        EXPECT_FALSE(
            test::find_collisions_on_cpu<float>(make_two_blocks({1, 0, 0}), {.broad_phase = broad_phase})
                .empty())
            << "face on face";
        EXPECT_FALSE(
            test::find_collisions_on_cpu<float>(make_two_blocks({1, 1, 1}), {.broad_phase = broad_phase})
                .empty())
            << "corner on corner";
        EXPECT_TRUE(
            test::find_collisions_on_cpu<float>(make_two_blocks({1.0001, 0, 0}), {.broad_phase = broad_phase})
                .empty());
        // Boxes meet, surfaces do not: discrete detection sees surfaces alone.
        EXPECT_TRUE(
            test::find_collisions_on_cpu<float>(make_two_blocks({0, 0, 3}), {.broad_phase = broad_phase})
                .empty());
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
