#include "cpu/collision/time_of_impact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vec3.hpp>
#include <random>

#include "cpu/collision/triangle_overlap.h"
#include "support/draw_vector.h"
#include "support/moving_pairs.h"

namespace gelatin {
namespace {

using test::MovingPair;
using test::PairOf;

// What comes nearer than this, over the extent, may count as touching.
constexpr double kNearness = 1e-3;

template <class Real>
class TimeOfImpact : public ::testing::Test {
protected:
    using Vector = cpu::Vec3<Real>;
    static MovingPair<Real> node_over_face(Vector start, Vector end) {
        const std::array<Vector, 3> face{Vector{0, 0, 0}, Vector{4, 0, 0}, Vector{0, 4, 0}};
        return {{{start, start, start}, {end, end, end}}, {face, face}};
    }
    static std::optional<Real> of_node(Vector start, Vector end) {
        return test::impact(PairOf::node_and_face, node_over_face(start, end));
    }
};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TimeOfImpact, Precisions);

TYPED_TEST(TimeOfImpact, IsWhereAPathMeetsAFace) {
    const double near = 1e-5;
    EXPECT_NEAR(this->of_node({1, 1, 3}, {1, 1, -1}).value(), 0.75, near) << "from above";
    EXPECT_NEAR(this->of_node({1, 1, -3}, {1, 1, 1}).value(), 0.75, near) << "from below";
    EXPECT_NEAR(this->of_node({-1, 0, 1}, {3, 0, -3}).value(), 0.25, near) << "onto a corner";
    EXPECT_NEAR(this->of_node({1, -5, 0}, {1, 5, 0}).value(), 0.5, near) << "in its plane";
    EXPECT_EQ(this->of_node({1, 1, 0}, {1, 1, 5}), TypeParam(0)) << "from it";
    EXPECT_NEAR(this->of_node({1, 1, 5}, {1, 1, 0}).value(), 1.0, near) << "onto it";
    EXPECT_FALSE(this->of_node({1, 1, 3}, {1, 1, 0.001}).has_value()) << "not far enough";
    EXPECT_FALSE(this->of_node({3, 3, 3}, {3, 3, -1}).has_value()) << "beside it";
    EXPECT_FALSE(this->of_node({1, 1, 3}, {1, 1, 3}).has_value()) << "at rest";
}

TYPED_TEST(TimeOfImpact, IsWhereEdgesMeet) {
    using Vec = cpu::Vec3<TypeParam>;
    const cpu::Moving<TypeParam, 2> still{{Vec{0, 0, 0}, Vec{4, 0, 0}}, {Vec{0, 0, 0}, Vec{4, 0, 0}}};
    const cpu::Moving<TypeParam, 2> falling{{Vec{1, -1, 3}, Vec{1, 1, 1}}, {Vec{1, -1, -1}, Vec{1, 1, -1}}};
    EXPECT_NEAR(cpu::time_of_impact(still, falling).value(), 2.0 / 3.0, 1e-5);
    const cpu::Moving<TypeParam, 2> beside{{Vec{5, -1, 3}, Vec{5, 1, 1}}, {Vec{5, -1, -1}, Vec{5, 1, -1}}};
    EXPECT_FALSE(cpu::time_of_impact(still, beside).has_value());
}

TYPED_TEST(TimeOfImpact, IsOfMotionRelativeToOneAnother) {
    auto pair = this->node_over_face({1, 1, 3}, {1, 1, -1});
    const auto alone = test::impact(PairOf::node_and_face, pair);
    for (auto* moving : {&pair.a, &pair.b}) {
        for (auto& p : moving->end) p += cpu::Vec3<TypeParam>(1024, -512, 4096);
    }
    EXPECT_EQ(test::impact(PairOf::node_and_face, pair), alone);
}

TYPED_TEST(TimeOfImpact, WhatIsNotFiniteTouches) {
    for (const TypeParam bad :
         {std::numeric_limits<TypeParam>::infinity(), std::numeric_limits<TypeParam>::quiet_NaN()}) {
        EXPECT_TRUE(this->of_node({1, 1, 3}, {1, 1, bad}).has_value());
        EXPECT_TRUE(this->of_node({bad, 1, 3}, {1, 1, 3}).has_value());
    }
}

// Every window of a plane is held against gaps in extended precision, planes lying as close as can be: the
// rounding bound is neither forgotten nor too small.
template <class Real>
void check_windows(std::size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<Real> unit(Real(-1), Real(1));
    const auto vector = [&] { return test::draw_vector<cpu::Vec3<Real>>(unit, random); };
    std::size_t open = 0;
    for (std::size_t n = 0; n < count; ++n) {
        // Corners in a plane across the normal, up to rounding, at the start or at the end.
        const cpu::Vec3<Real> normal = vector(), u = glm::cross(normal, vector()), v = glm::cross(normal, u);
        MovingPair<Real> pair;
        for (auto* moving : {&pair.a, &pair.b}) {
            for (int k = 0; k < 3; ++k) {
                moving->start[k] = unit(random) * u + unit(random) * v;
                moving->end[k] = moving->start[k];
                if (n % 3 == 1) moving->end[k] += vector();
                if (n % 3 == 2) moving->start[k] += vector();
            }
        }
        const cpu::Vec3<Real> shift = Real(1e-6) * std::abs(unit(random)) * normal;
        for (int k = 0; k < 3; ++k) {
            pair.b.start[k] += shift;
            pair.b.end[k] += shift;
        }
        MovingPair<Real> relative = pair;
        const cpu::Vec3<Real> reach = cpu::impact::make_relative(relative.a, relative.b);
        const auto window = cpu::impact::separating_window(relative.a, relative.b, normal, reach);
        if (window.first > window.last) continue;
        ++open;
        using Long = glm::vec<3, long double>;
        for (const long double time :
             {static_cast<long double>(window.first), static_cast<long double>(window.last)}) {
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) {
                    const Long start = Long(pair.b.start[j]) - Long(pair.a.start[i]),
                               end = Long(pair.b.end[j]) - Long(pair.a.end[i]);
                    EXPECT_GT(glm::dot(Long(normal), start + time * (end - start)), 0.0L);
                }
            }
        }
    }
    EXPECT_GT(open, count / 100);
}

TEST(TimeOfImpactAgainstReference, PlanesSeparateWhenTheySay) {
    check_windows<float>(100'000);
    check_windows<double>(30'000);
}

bool overlap_at_start(const cpu::Moving<double, 3>& a, const cpu::Moving<double, 3>& b) {
    return cpu::triangles_overlap(a.start, b.start);
}

template <class Real>
MovingPair<double> to_double(const MovingPair<Real>& pair) {
    MovingPair<double> result;
    for (int k = 0; k < 3; ++k) {
        result.a.start[k] = pair.a.start[k];
        result.a.end[k] = pair.a.end[k];
        result.b.start[k] = pair.b.start[k];
        result.b.end[k] = pair.b.end[k];
    }
    return result;
}

// How far apart they are at the time of an alleged impact, over their extent. (Where faces pierce one another
// already, the distance of their edges and corners says nothing.)
double alarm_distance(const MovingPair<double>& pair, double time) {
    if (overlap_at_start(pair.a, pair.b)) return 0.0;
    return test::distance_at(pair, time) / test::extent(pair);
}

// No impact is missed, none is late, and what counts as one is at least near. What comes within a billionth
// of the extent is taken to touch: of random pairs one in a billion does not.
template <class Real>
void compare_random_pairs(std::size_t count, unsigned seed) {
    for (const auto& [what, name] : test::kPairsOf) {
        SCOPED_TRACE(name);
        std::size_t impacts = 0, misses = 0, late = 0, false_alarms = 0, far_alarms = 0;
        for (const auto& random : test::random_moving_pairs<Real>(what, count, seed)) {
            const std::optional<Real> actual = test::impact(what, random);
            const MovingPair<double> pair = to_double(random);
            const std::optional<double> expected = test::comes_near(pair, 1e-9 * test::extent(pair));
            misses += expected && !actual;
            if (!actual) continue;
            const auto time = static_cast<double>(*actual);
            ++impacts;
            false_alarms += !expected;
            late += expected && time > *expected + 1e-3;
            far_alarms += alarm_distance(pair, time) > kNearness;
        }
        EXPECT_GT(impacts, count / 100);
        EXPECT_EQ(misses, 0u);
        EXPECT_EQ(late, 0u);
        EXPECT_LE(far_alarms, count / 100'000);
        EXPECT_LE(false_alarms, count / 10'000);
    }
}

// Most of them miss one another by 1e-8 to 1e-2 of the extent, some while they turn over within the step.
template <class Real>
void compare_near_pairs(std::size_t count, unsigned seed) {
    for (const auto& [what, name] : test::kPairsOf) {
        SCOPED_TRACE(name);
        std::size_t impacts = 0, alarms = 0, far_alarms = 0;
        for (const auto& near : test::nearly_touching_pairs<Real>(what, count, seed)) {
            const std::optional<Real> time = test::impact(what, near);
            if (!time) continue;
            const double apart = alarm_distance(to_double(near), static_cast<double>(*time));
            ++impacts;
            alarms += apart > 1e-5;
            far_alarms += apart > kNearness;
        }
        EXPECT_GT(impacts, count / 20);
        EXPECT_LT(impacts, count * 19 / 20);
        EXPECT_LT(alarms, impacts / 10);
        EXPECT_LT(far_alarms, impacts / 50);
    }
}

template <class Real>
void expect_all_touch(std::size_t count, unsigned seed) {
    for (const auto& [what, name] : test::kPairsOf) {
        SCOPED_TRACE(name);
        std::size_t misses = 0;
        for (const auto& pair : test::touching_pairs<Real>(what, count, seed))
            misses += !test::impact(what, pair).has_value();
        EXPECT_EQ(misses, 0u);
    }
}

TEST(TimeOfImpactAgainstReference, RandomPairs) {
    compare_random_pairs<float>(5'000, 1);
    compare_random_pairs<double>(2'000, 2);
}

TEST(TimeOfImpactAgainstReference, PairsThatNearlyTouch) {
    compare_near_pairs<float>(10'000, 3);
    compare_near_pairs<double>(10'000, 4);
}

TEST(TimeOfImpactAgainstReference, PairsThatTouch) {
    expect_all_touch<float>(50'000, 5);
    expect_all_touch<double>(50'000, 6);
}

TEST(TimeOfImpactLong, RandomPairs) {
    compare_random_pairs<float>(400'000, 7);
}

TEST(TimeOfImpactLong, PairsThatTouch) {
    expect_all_touch<float>(500'000, 8);
    expect_all_touch<double>(500'000, 9);
}

}  // namespace
}  // namespace gelatin
