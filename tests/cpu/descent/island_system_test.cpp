#include "cpu/descent/island_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "cpu/descent/island_search.h"

namespace gelatin {
namespace {

using cpu::IslandSystem, cpu::Motion, cpu::MotionMatrix;

// A body of m / h^2 = 1 MN/m that lies on a belt, which presses it up by some 10 kN.
// @param slip by which the belt has moved along x in the step [m]
IslandSystem on_a_belt(double slip) {
    IslandSystem island;
    IslandSystem::Body& body = island.bodies.emplace_back(0u);
    body.stiffness = 1e6;
    body.matrix = MotionMatrix::Identity() * 1e6;
    body.force << 0.0, -1e4, 0.0, 0.0, 0.0, 0.0;
    island.is_held = true;
    for (const double x : {-1.0, 1.0}) {
        IslandSystem::Touch touch;
        touch.bodies = {kNoNode, 0};
        touch.arms[1] = {x, 0.0, 0.0};
        touch.normal = {0.0, 1.0, 0.0};
        touch.reach = 5e-3;
        touch.stiffness = 1e8;
        touch.gap = touch.reach - 5e-5;
        touch.friction = 0.5;
        touch.hold = {-touch.stiffness * slip, 0.0, 0.0};  // the belt is ahead of the body
        island.touches.push_back(touch);
    }
    return island;
}

// More contacts than a task has.
TEST(IslandSystem, ManySoftContactsAreAFewStiffOnes) {
    for (const double slip : {0.1e-3, 20e-3}) {
        IslandSystem many = on_a_belt(slip);
        for (IslandSystem::Touch& touch : many.touches) touch.stiffness /= 700.0, touch.hold /= 700.0;
        const std::vector<IslandSystem::Touch> once = many.touches;
        for (int k = 1; k < 700; ++k) many.touches.insert(many.touches.end(), once.begin(), once.end());
        const Motion motion = many.find_motions()[0], expected = on_a_belt(slip).find_motions()[0];
        EXPECT_LT((motion - expected).norm(), 1e-6 * expected.norm()) << slip;
    }
}

// Newton's step takes the force of a slip for one without an end: 5 kN, which are 5 mm.
TEST(IslandSystem, FrictionMovesABodyNoFartherThanABelt) {
    for (const double slip : {0.1e-3, 1e-3, 3e-3}) {
        const std::vector<Motion> motions = on_a_belt(slip).find_motions();
        EXPECT_NEAR(motions[0](0), slip, 0.05 * slip) << slip;
    }
    EXPECT_NEAR(on_a_belt(20e-3).find_motions()[0](0), 5e-3, 0.3e-3);
}

// The body is pulled along the belt, which rests. It presses the belt already, or comes down on it in this
// step.
TEST(IslandSystem, BodiesSlideOnWhatTheyFallOnto) {
    for (const double above : {-5e-5, 1e-5, 1e-3}) {
        for (const double pull : {3e3, 6e3, 1e4, 5e4}) {
            IslandSystem island = on_a_belt(0.0);
            island.bodies[0].force(0) = pull;
            for (IslandSystem::Touch& touch : island.touches) touch.gap = touch.reach + above;
            const Motion motion = island.find_motions()[0];
            const double pressing = (1e4 - 1e6 * above) / (1.0 + 1e6 / 2e8);
            const double sliding = std::max(0.0, (pull - 0.5 * pressing) / 1e6);
            EXPECT_NEAR(motion(0), sliding > 0.0 ? sliding : pull / 2e8, 0.01 * pull / 1e6)
                << above << ' ' << pull;
            EXPECT_NEAR(motion(1), -above - pressing / 2e8, 1e-7) << above << ' ' << pull;
        }
    }
}

// The belt, which is held, is still on its way: the body goes with it, as far as friction takes it, and is
// not pressed before it does.
TEST(IslandSystem, WhatIsHeldCarriesBodiesAlong) {
    const auto carried = [](const glm::dvec3& way) {
        IslandSystem island = on_a_belt(0.0);
        for (IslandSystem::Touch& touch : island.touches) touch.carried = -way;
        const std::vector<Motion> motions = island.find_motions();
        return std::pair(motions[0], island.touches[0].gap);
    };
    for (const double way : {0.1e-3, 1e-3, 3e-3}) {
        EXPECT_NEAR(carried({way, 0.0, 0.0}).first(0), way, 0.05 * way);
        const auto [motion, gap] = carried({0.0, way, 0.0});
        const double pressed = 5e-5 + way * 1e6 / 2e8;  // into the reach, by what lifts the body
        EXPECT_NEAR(motion(1), way + 5e-5 - pressed, 0.01 * way);
        EXPECT_NEAR(gap, 5e-3 - pressed, 0.01 * pressed);
    }
    EXPECT_NEAR(carried({20e-3, 0.0, 0.0}).first(0), 5e-3, 0.3e-3);
    EXPECT_GT(carried({0.0, 20e-3, 0.0}).second, 0.0);
}

// A collider holds a corner of the lower body: its way up is a turn about that. The upper body lets it make
// little of it, and then it must not go up without turning.
TEST(IslandSystem, WhatCollidersHoldDoesNotJump) {
    IslandSystem island;
    for (std::uint32_t k = 0; k < 2; ++k) {
        IslandSystem::Body& body = island.bodies.emplace_back(k);
        body.stiffness = 1e4;
        body.matrix = MotionMatrix::Identity() * 1e4;
    }
    const Motion corner = cpu::along({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    island.bodies[0].matrix += 1e8 * corner * corner.transpose();
    island.bodies[0].force << 0.0, 300.0, 0.0, 0.0, 0.0, 0.0;
    island.is_outside_touched = true;
    IslandSystem::Touch touch;
    touch.bodies = {0, 1};
    touch.normal = {0.0, 1.0, 0.0};
    touch.gap = touch.reach = 5e-3;
    touch.stiffness = 1e8;
    island.touches.push_back(touch);
    const std::vector<Motion> motions = island.find_motions();
    double objective = 0.0;  // of all but the contact, whose energy can only rise
    for (std::size_t k = 0; k < 2; ++k) {
        const IslandSystem::Body& body = island.bodies[k];
        objective += 0.5 * motions[k].dot(body.matrix * motions[k]) - motions[k].dot(body.force);
    }
    EXPECT_LT(objective, 0.0);
}

// Bodies of a crowd, each above a belt of its own, fall onto it from where they are.
TEST(IslandSystem, BodiesOfACrowdMoveAsEachAlone) {
    const auto above = [](std::uint32_t body) { return 1e-5 * static_cast<double>(body); };
    IslandSystem crowd;
    for (std::uint32_t k = 0; k < 200; ++k) {
        IslandSystem one = on_a_belt(0.0);
        one.bodies[0].force(0) = 6e3;
        for (IslandSystem::Touch& touch : one.touches) touch.gap = touch.reach + above(k);
        crowd.bodies.push_back(one.bodies[0]);
        for (IslandSystem::Touch touch : one.touches) {
            touch.bodies[1] = k;
            crowd.touches.push_back(touch);
        }
    }
    crowd.is_held = true;
    const std::vector<Motion> motions = crowd.find_motions();
    for (std::uint32_t k = 0; k < crowd.bodies.size(); ++k) {
        IslandSystem one = on_a_belt(0.0);
        one.bodies[0].force(0) = 6e3;
        for (IslandSystem::Touch& touch : one.touches) touch.gap = touch.reach + above(k);
        EXPECT_LT((motions[k] - one.find_motions()[0]).norm(), 2e-4) << k;
    }
}

// From half of the gap at the start on, of no more than the reach, forces grow linearly.
TEST(IslandSystem, BodiesGoFarIntoSoftContacts) {
    const auto depth = [](double gap) {
        IslandSystem island = on_a_belt(0.0);
        island.bodies[0].force(1) = -2e4;
        for (IslandSystem::Touch& touch : island.touches) {
            touch.stiffness = 5e5;
            touch.friction = 0.0;
            touch.hold = {};
            touch.gap = gap;
        }
        return -island.find_motions()[0](1);
    };
    EXPECT_NEAR(depth(5e-3), 2e4 / 2e6, 1e-6);
    EXPECT_NEAR(depth(7e-3), 2e-3 + (2e4 - 2e3) / 2e6, 1e-6);
    const double least = 0.5e-3, stiffness = 0.25 * 1e6 * 25e-6 / (least * least);  // the barrier's there
    EXPECT_NEAR(depth(1e-3), 0.5e-3 + (2e4 - 500.0 - stiffness * least) / (1e6 + stiffness), 1e-6);
}

constexpr std::uint32_t kRow = 12;

// Bodies above each other, 1 mm above the reach of a belt; all fall by 20 mm.
// @param between how much wider than the reach gaps between them are [m]
// @param is_turned whether the upper body of a contact is its first
IslandSystem row_above_a_belt(double between, bool is_turned) {
    IslandSystem row;
    row.is_held = true;
    for (std::uint32_t k = 0; k < kRow; ++k) {
        IslandSystem one = on_a_belt(0.0);
        one.bodies[0].force(1) = -2e4;
        row.bodies.push_back(one.bodies[0]);
        for (IslandSystem::Touch touch : one.touches) {
            touch.bodies = {k == 0 ? kNoNode : k - 1, k};
            touch.arms[0] = touch.arms[1];
            touch.gap = touch.reach + (k == 0 ? 1e-3 : between);
            if (is_turned) {
                std::swap(touch.bodies[0], touch.bodies[1]);
                touch.normal = -touch.normal;
            }
            row.touches.push_back(touch);
        }
    }
    return row;
}

// Each meets the next on the way, or presses it from the start. All are in balance in the end.
TEST(IslandSystem, ARowMeetsInOneMotion) {
    for (const double between : {1e-3, -1e-5}) {
        for (const bool is_turned : {false, true}) {
            const std::vector<Motion> motions = row_above_a_belt(between, is_turned).find_motions();
            std::vector<double> pressing(kRow + 1);  // what is below each, by where both went
            for (std::uint32_t k = 0; k < kRow; ++k) {
                const double gap =
                    k == 0 ? 1e-3 + motions[0](1) : between + motions[k](1) - motions[k - 1](1);
                pressing[k] = 2e8 * std::max(0.0, -gap);
            }
            for (std::uint32_t k = 0; k < kRow; ++k)
                EXPECT_NEAR(pressing[k] - pressing[k + 1], 2e4 + 1e6 * motions[k](1), 200.0)
                    << between << ' ' << is_turned << ' ' << k;
        }
    }
}

// Each stops on what is below it, where that has stopped, and is not pressed by what goes on above.
TEST(IslandSearch, ARowStopsBodyByBody) {
    Motion fall = Motion::Zero();
    fall(1) = -20e-3;
    for (const bool is_turned : {false, true}) {
        const std::vector<double> parts =
            cpu::least_parts(row_above_a_belt(1e-3, is_turned), std::vector<Motion>(kRow, Motion::Zero()),
                             std::vector<Motion>(kRow, fall));
        double below = 0.0;  // where what is below ends [m]
        for (std::uint32_t k = 0; k < kRow; ++k) {
            const double end = (2e4 + 2e8 * (below + 1e-3)) / (1e6 + 2e8);
            EXPECT_NEAR(20e-3 * parts[k], end, 2e-6) << is_turned << ' ' << k;
            below = end;
        }
    }
}

}  // namespace
}  // namespace gelatin
