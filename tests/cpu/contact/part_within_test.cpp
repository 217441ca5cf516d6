#include "cpu/contact/part_within.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "cpu/collision/nearest_points.h"
#include "cpu/contact/contact_list.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

// A motion stays inside up to its part, and is outside a little later.
// @param more a part that is outside @param is_inside of a part
template <class Inside>
void expect_leaves_at(double part, double more, const Inside& is_inside, unsigned round) {
    constexpr int kSamples = 200;
    ASSERT_GE(part, 0.0);
    ASSERT_LE(part, 1.0);
    for (int k = 0; k <= kSamples; ++k)
        ASSERT_TRUE(is_inside(part * k / kSamples)) << round << ", at " << k << " of " << part;
    if (part < 1.0) {
        EXPECT_FALSE(is_inside(more)) << round << ", " << part;
    }
}

template <class Real>
void expect_balls_are_left() {
    test::RandomMaker random(1);
    constexpr double kRadius = 0.3;
    // The part is short of the surface by a thousandth. A motion may leave it at a small angle, and
    // kRounding above it is inside, too.
    constexpr bool kIsFloat = std::is_same_v<Real, float>;
    constexpr double kRounding = kIsFloat ? 1e-5 : 1e-12, kMore = kIsFloat ? 1.02 : 1.002;
    int whole = 0;
    for (unsigned round = 0; round < 2000; ++round) {
        glm::dvec3 start = random.point(kRadius);
        while (glm::length(start) > 0.99 * kRadius) start = random.point(kRadius);
        const glm::dvec3 motion = random.point(random.magnitude(1e-3, 1e3));
        const auto part = static_cast<double>(cpu::part_within<Real>(
            cpu::Vec3<Real>(start), cpu::Vec3<Real>(motion), static_cast<Real>(kRadius)));
        whole += part == 1.0 ? 1 : 0;
        const auto is_inside = [&](double of) {
            return glm::length(start + of * motion) <= (1.0 + kRounding) * kRadius;
        };
        expect_leaves_at(part, kMore * part + 1e-6 * kRadius / glm::length(motion), is_inside, round);
    }
    EXPECT_GT(whole, 500);
    EXPECT_LT(whole, 1500);
}

TEST(PartWithin, IsWhereAMotionLeavesABall) {
    expect_balls_are_left<double>();
    expect_balls_are_left<float>();
}

TEST(PartWithin, IsNoneFromOutside) {
    const glm::dvec3 start(0.5, 0, 0);
    EXPECT_EQ(cpu::part_within<double>(start, {1, 0, 0}, 0.3), 0.0);
    EXPECT_EQ(cpu::part_within<double>(start, {-3, 0, 0}, 0.3), 0.0);  // through it
    EXPECT_EQ(cpu::part_within<double>(start, {0, 0, 0}, 0.3), 0.0);
    EXPECT_EQ(cpu::part_within<double>(0.5 * start, {0, 0, 0}, 0.3), 1.0);
}

// Rooms are all that is nearer to the way than the radius, beyond its ends, too.
TEST(ContactList, PartsStayWithinRooms) {
    test::RandomMaker random(2);
    constexpr double kRadius = 0.3;
    cpu::ContactList<double> list;
    list.rooms = {kRadius};
    int whole = 0, outside = 0, beyond_ends = 0;
    for (unsigned round = 0; round < 2000; ++round) {
        const glm::dvec3 way = round % 4 == 0 ? glm::dvec3(0) : random.point(random.magnitude(0.1, 2.0));
        list.ways = {way};
        const auto from_way = [&](const glm::dvec3& p) {
            return std::sqrt(cpu::nearest_points<double>(p, glm::dvec3(0), way).squared_distance);
        };
        const glm::dvec3 start = random.uniform(0.0, 1.0) * way + random.point(0.25),
                         motion = random.point(random.magnitude(0.01, 5.0));
        EXPECT_NEAR(list.beside_way(0, start), from_way(start), 1e-12);
        const double part = list.part_within_room(0, start, motion);
        if (from_way(start) > kRadius) {
            ++outside;
            EXPECT_EQ(part, from_way(start + motion) <= kRadius ? 1.0 : 0.0) << round;
            continue;
        }
        whole += part == 1.0 ? 1 : 0;
        const glm::dvec3 end = start + part * motion;
        if (part < 1.0 && (glm::dot(end, way) < 0.0 || glm::dot(end - way, way) > 0.0)) ++beyond_ends;
        // By halving an interval ten times.
        const double more = way == glm::dvec3(0) ? 1.002 * part + 1e-9 : part + 1.0 / 1024.0;
        expect_leaves_at(
            part, more, [&](double of) { return from_way(start + of * motion) <= (1.0 + 1e-12) * kRadius; },
            round);
    }
    EXPECT_GT(whole, 400);
    EXPECT_LT(whole, 1600);
    EXPECT_GT(outside, 50);
    EXPECT_GT(beyond_ends, 100);
}

}  // namespace
}  // namespace gelatin
