#include "cpu/contact/pair_course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "cpu/collision/nearest_points.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

using cpu::Closeness;
using Corners = std::array<glm::dvec3, 4>;

constexpr double kCourseReach = 0.1;  // [m]
constexpr int kCourseSamples = 100;

cpu::ContactPair make_pair(bool are_edges) {
    return {{0, 1, 2, 3}, {}, 0, 0, 0, 0, are_edges ? 2u : 1u, float(kCourseReach)};
}

glm::dvec3 apart(const cpu::ContactPair& pair, const Corners& at) {
    if (pair.is_edges())
        return cpu::nearest_points<double>(std::array{at[0], at[1]}, std::array{at[2], at[3]}).apart;
    return cpu::nearest_points<double>(at[0], std::array{at[1], at[2], at[3]}).apart;
}

// Each node on its own part of its motion.
double gap_at(const cpu::ContactPair& pair, const Corners& nodes, const Corners& motions,
              const std::array<double, 4>& parts) {
    Corners at;
    for (std::size_t k = 0; k < 4; ++k) at[k] = nodes[k] + parts[k] * motions[k];
    return glm::length(apart(pair, at));
}

// All of them on the same.
double gap_at(const cpu::ContactPair& pair, const Corners& nodes, const Corners& motions, double part) {
    return gap_at(pair, nodes, motions, {part, part, part, part});
}

Corners random_corners(test::RandomMaker& random, double extent) {
    Corners corners;
    for (glm::dvec3& corner : corners) corner = random.point(extent);
    return corners;
}

// A pair of any size and motion, aimed where it is, or a while ago.
struct MovingPair {
    MovingPair(unsigned seed, double yielding) : pair(make_pair(seed % 2 == 0)) {
        test::RandomMaker random(seed);
        nodes = random_corners(random, random.magnitude(0.05, 2.0));
        motions = random_corners(random, random.magnitude(1e-3, 2.0));
        const double before = seed % 3 == 0 ? random.magnitude(1e-3, 0.3) : 0.0;
        Corners aimed = nodes;
        for (glm::dvec3& node : aimed) node += random.point(before);
        const glm::dvec3 between = apart(pair, aimed);
        aim = {glm::normalize(between), glm::length(between), yielding};
    }
    cpu::PairCourse<double> course(Closeness closeness) const {
        return cpu::best_course<double>(pair, aim, kCourseReach, nodes, motions, closeness);
    }

    cpu::ContactPair pair;
    Corners nodes, motions;
    cpu::PairAim<double> aim;
};

// A tenth of it for motions. For guesses half of the reach or of the gap, or more where nodes are stiff. What
// stays as it is, is always free.
TEST(LeastGap, IsAPartOfTheGap) {
    const auto least = [](double yielding, double gap, Closeness closeness) {
        return cpu::least_gap<double>({{1, 0, 0}, gap, yielding}, kCourseReach, gap, closeness);
    };
    // Constants are those of float.
    EXPECT_NEAR(least(0.5, 1.0, Closeness::motion), 0.1, 1e-8);
    EXPECT_NEAR(least(0.5, 0.02, Closeness::motion), 0.005, 1e-8);  // a twentieth of the reach
    EXPECT_NEAR(least(0.5, 0.003, Closeness::motion), 0.003, 1e-8);
    EXPECT_NEAR(least(1.0, 1.0, Closeness::guess), 0.05, 1e-8);
    EXPECT_NEAR(least(1.0, 0.04, Closeness::guess), 0.02, 1e-8);
    EXPECT_NEAR(least(0.5, 0.04, Closeness::guess), 0.03, 1e-8);
    EXPECT_NEAR(least(0.0, 0.04, Closeness::guess), 0.04, 1e-8);
    EXPECT_NEAR(least(1.0, 0.004, Closeness::guess), 0.004, 1e-8);  // below a tenth of the reach
    test::RandomMaker random(1);
    for (const Closeness closeness : {Closeness::motion, Closeness::guess}) {
        for (int k = 0; k < 500; ++k) {
            const double yielding = random.uniform(0.0, 1.0), gap = random.magnitude(1e-5, 1.0);
            const double here = least(yielding, gap, closeness);
            EXPECT_GT(here, 0.0);
            EXPECT_LE(here, gap);
            EXPECT_LE(here, least(yielding, 1.01 * gap, closeness));
            EXPECT_NEAR(here, least(yielding, (1.0 + 1e-9) * gap, closeness), 1e-8 * gap);
        }
    }
}

TEST(PartLeft, LeavesTheLeast) {
    EXPECT_EQ(cpu::part_left(1.0, 0.3, 0.2), 1.0);
    EXPECT_EQ(cpu::part_left(0.1, 0.0, 0.2), 0.0);
    test::RandomMaker random(2);
    for (int k = 0; k < 500; ++k) {
        const double least = random.uniform(0.0, 1.0), start = least + random.magnitude(1e-3, 1.0),
                     end = least - random.magnitude(1e-3, 1.0);
        const double left = start + cpu::part_left(start, end, least) * (end - start);
        EXPECT_GE(left, least);
        EXPECT_LE(left, least + 0.0011 * (start - least));
    }
}

// Whatever the direction: a course that is free does not bring the pair nearer than it says.
TEST(PairCourse, LeavesTheGapWhereItIsFree) {
    int free = 0, blocked = 0;
    for (unsigned seed = 1; seed < 3000; ++seed) {
        const MovingPair moving(seed, 0.5);
        for (const Closeness closeness : {Closeness::motion, Closeness::guess}) {
            const cpu::PairCourse<double> course = moving.course(closeness);
            EXPECT_GT(course.least, 0.0);
            if (!course.is_free()) {
                ++blocked;
                continue;
            }
            ++free;
            const double least = std::min(course.least, course.gap_at(0.0));
            for (int k = 0; k <= kCourseSamples; ++k) {
                const double part = double(k) / kCourseSamples;
                const double gap = gap_at(moving.pair, moving.nodes, moving.motions, part);
                ASSERT_GE(gap, least - 1e-12) << seed << ", at " << part;
                ASSERT_GE(gap, course.gap_at(part) - 1e-12) << seed << ", at " << part;
            }
        }
    }
    EXPECT_GT(free, 2500);
    EXPECT_GT(blocked, 800);
}

// Nodes may make any parts up to those with which it stays free.
TEST(PairCourse, LeavesTheGapWhateverPartsNodesMake) {
    test::RandomMaker random(3);
    int free = 0, blocked = 0;
    for (unsigned seed = 1; seed < 3000; ++seed) {
        const MovingPair moving(seed, 0.5);
        const cpu::PairCourse<double> course = moving.course(Closeness::motion);
        std::array<double, 4> most;
        for (double& part : most) part = random.uniform(0.0, 1.0);
        if (!course.stays_free([&](std::size_t k) { return most[k]; })) {
            ++blocked;
            continue;
        }
        ++free;
        for (int sample = 0; sample < kCourseSamples; ++sample) {
            std::array<double, 4> parts;
            for (std::size_t k = 0; k < 4; ++k)
                parts[k] = most[k] * double(random.integer(0, 4)) / 4.0;  // all and none among them
            ASSERT_GE(gap_at(moving.pair, moving.nodes, moving.motions, parts), course.least - 1e-12) << seed;
        }
    }
    EXPECT_GT(free, 1000);
    EXPECT_GT(blocked, 500);
}

TEST(PairCourse, IsFreeForWhatStaysOrPartsOrGoesTogether) {
    test::RandomMaker random(4);
    for (unsigned seed = 1; seed < 1000; ++seed) {
        MovingPair moving(seed, 0.5);
        const glm::dvec3 common = random.point(10.0),
                         parting = double(seed % 2) * apart(moving.pair, moving.nodes);
        for (std::size_t k = 0; k < 4; ++k)
            moving.motions[k] = moving.pair.side_of(k) == 0 ? common : common + parting;
        for (const Closeness closeness : {Closeness::motion, Closeness::guess})
            EXPECT_TRUE(moving.course(closeness).is_free()) << seed;
    }
}

// Whatever their shapes: corners that slide over faces, and edges along each other.
TEST(PairCourse, IsFreeForWhatPassesBeside) {
    test::RandomMaker random(5);
    for (unsigned seed = 1; seed < 3000; ++seed) {
        MovingPair moving(seed, random.uniform(0.0, 1.0));
        const glm::dvec3 direction = glm::normalize(random.point(1.0)), way = random.point(1.0);
        double top = -1e9, low = 1e9;
        for (std::size_t k = 0; k < 4; ++k) {
            const double height = glm::dot(direction, moving.nodes[k]);
            (moving.pair.side_of(k) == 0 ? top : low) =
                moving.pair.side_of(k) == 0 ? std::max(top, height) : std::min(low, height);
        }
        const double gap = random.magnitude(0.06, 2.0) * kCourseReach;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool is_first = moving.pair.side_of(k) == 0;
            if (!is_first) moving.nodes[k] += (top - low + gap) * direction;
            moving.motions[k] = is_first ? glm::dvec3(0) : way - glm::dot(way, direction) * direction;
        }
        const glm::dvec3 between = apart(moving.pair, moving.nodes);
        moving.aim.normal = glm::normalize(between);
        moving.aim.gap = glm::length(between);
        for (const Closeness closeness : {Closeness::motion, Closeness::guess})
            EXPECT_TRUE(moving.course(closeness).is_free()) << seed;
    }
}

TEST(PairCourse, KnowsTheGapWhateverTheAim) {
    for (unsigned seed = 1; seed < 500; ++seed) {
        MovingPair moving(seed, 0.5);
        const glm::dvec3 between = apart(moving.pair, moving.nodes);
        moving.motions = {};
        for (const double side : {1.0, -1.0}) {
            moving.aim.normal = side * glm::normalize(between);
            const cpu::PairCourse<double> course = moving.course(Closeness::motion);
            EXPECT_NEAR(course.gap_at(0.0), glm::length(between), 1e-12) << seed;
        }
    }
}

// Neither the direction at the start nor that at the end separates them all the way.
TEST(PairCourse, IsFreeForWhatSlidesAbove) {
    for (const double side : {1.0, -1.0}) {
        const glm::dvec3 start(-3, 0.2, side * 0.3), motion(6, 0, 0);
        const cpu::ContactPair of_face = make_pair(false), of_edges = make_pair(true);
        const Corners node_and_face{start, {-1, -1, 0}, {1, -1, 0}, {0, 2, 0}};
        const Corners edges{
            {start - glm::dvec3(0, 1, 0), start + glm::dvec3(0, 1, 0), {-1, 0.1, 0}, {1, 0.1, 0}}};
        for (const auto& [pair, nodes] : {std::pair(of_face, node_and_face), std::pair(of_edges, edges)}) {
            const glm::dvec3 between = apart(pair, nodes);
            const cpu::PairAim<double> aim{glm::normalize(between), glm::length(between), 0.5};
            const Corners motions{motion, pair.is_edges() ? motion : glm::dvec3(0), {0, 0, 0}, {0, 0, 0}};
            EXPECT_TRUE(cpu::best_course<double>(pair, aim, kCourseReach, nodes, motions, Closeness::motion)
                            .is_free());
            Corners through = motions;  // but not if it goes through on the way
            through[0].z -= 0.6 * side;
            if (pair.is_edges()) through[1].z -= 0.6 * side;
            EXPECT_FALSE(cpu::best_course<double>(pair, aim, kCourseReach, nodes, through, Closeness::motion)
                             .is_free());
        }
    }
}

// A pair that turns with its body stays apart, and what passes through another is not taken for apart.
TEST(PairApart, IsApartAllTheWay) {
    test::RandomMaker random(7);
    int whole = 0, parts = 0;
    for (int round = 0; round < 4000; ++round) {
        const cpu::ContactPair pair = make_pair(round % 2 == 0);
        const bool is_rigid = round % 8 < 4;
        const glm::dquat turn = glm::angleAxis(random.uniform(0.0, 0.4), glm::dvec3(0, 0, 1));
        const double noise = random.magnitude(1e-2, 3.0);
        const Corners nodes = random_corners(random, 1.0);
        Corners moved, motions;
        for (std::size_t k = 0; k < 4; ++k) {
            moved[k] = turn * nodes[k] + glm::dvec3(1, 2, 3) + random.point(is_rigid ? 0.0 : noise);
            motions[k] = moved[k] - nodes[k];
        }
        const double start = gap_at(pair, nodes, motions, 0.0);
        const cpu::PairAim<double> aim{{1, 0, 0}, start, 0.5};
        const double part = cpu::part_apart<double>(pair, aim, kCourseReach, nodes, moved, Closeness::motion);
        if (is_rigid && start > kCourseReach) {
            EXPECT_EQ(part, 1.0) << round;
        }
        if (part < 1.0) {
            ++parts;
            const double least = cpu::least_gap<double>(aim, kCourseReach, start, Closeness::motion);
            for (int k = 0; k <= kCourseSamples; ++k)
                ASSERT_GE(gap_at(pair, nodes, motions, part * k / kCourseSamples), least - 1e-12) << round;
            continue;
        }
        ++whole;
        // By steps that are too short to touch.
        double speed = 0.0;
        for (const glm::dvec3& motion : motions) speed = std::max(speed, glm::length(motion - motions[0]));
        for (double at = 0.0; at < 1.0;) {
            const double now = gap_at(pair, nodes, motions, at);
            ASSERT_GT(now, 1e-7) << round;
            at += 0.5 * now / std::max(speed, 1e-9);
        }
    }
    EXPECT_GT(whole, 1500);
    EXPECT_GT(parts, 100);
}

}  // namespace
}  // namespace gelatin
