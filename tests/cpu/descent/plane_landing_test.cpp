#include "cpu/descent/plane_landing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtx/rotate_vector.hpp>

#include "cpu/descent/wave_times.h"
#include "support/contact_scenes.h"

namespace gelatin {
namespace {

constexpr double kLandingStep = 1.0 / 60.0;  // [s]

// A block that is turned round z and leads into a floor, and into a wall where x = 0. It has slid by `slip`
// since the step began.
struct Landing {
    std::shared_ptr<const Model> model;
    std::vector<glm::dvec4> guess, positions;
    bool lands = false;

    // @param push on each node of the lowest layer, before it was led there [N]
    Landing(double youngs_modulus, double angle, const glm::dvec2& depth, const glm::dvec3& slip = {},
            double friction = 0.0, const glm::dvec3& push = {}) {
        std::vector<ColliderDescription> planes(2);
        for (ColliderDescription& plane : planes) plane.friction = friction;
        planes[0].shape = PlaneCollider{{0, 1, 0}, 0.0};
        planes[1].shape = PlaneCollider{{1, 0, 0}, 0.0};
        model = test::make_blocks({{.youngs_modulus = youngs_modulus}}, {}, planes);
        glm::dvec3 least(1e9);
        for (const glm::vec4& p : model->positions)
            guess.emplace_back(glm::rotateZ(glm::dvec3(p), angle), static_cast<double>(p.w));
        for (const glm::dvec4& p : guess) least = glm::min(least, glm::dvec3(p));
        cpu::StepObjective<double> objective(model, model->node_count());
        for (std::size_t n = 0; n < guess.size(); ++n) {
            guess[n] -= glm::dvec4(least.x + depth.x, least.y + depth.y, 0.0, 0.0);
            objective.step.starts[n] = guess[n] - glm::dvec4(slip, 0.0);
            objective.step.targets[n] = glm::dvec4(
                glm::dvec3(guess[n]), static_cast<double>(model->masses[n]) / (kLandingStep * kLandingStep));
        }
        positions = guess;
        const std::vector<double> times = cpu::wave_times(*model);
        cpu::PlaneLanding<double> landing(model, times);
        lands = landing.begin(kLandingStep, objective, positions);
        if (push == glm::dvec3(0.0)) return;
        positions = guess;
        std::vector<glm::dvec3> forces(guess.size());
        for (std::size_t n = 0; n < guess.size(); ++n)
            if (guess[n].y < -0.99 * depth.y) forces[n] = push;
        landing.land(0, objective, forces, positions);
    }
    double weight(double depth) const {  // that brings it down by so much in a step [N]
        double mass = 0.0;
        for (const float own : model->masses) mass += static_cast<double>(own);
        return mass * depth / (kLandingStep * kLandingStep);
    }
    int lowest_count() const {
        const double low = std::ranges::min(guess, {}, &glm::dvec4::y).y;
        return static_cast<int>(
            std::ranges::count_if(guess, [&](const glm::dvec4& p) { return p.y < low + 1e-6; }));
    }

    double least(int axis) const {
        double least = 1e9;
        for (const glm::dvec4& p : positions) least = std::min(least, p[axis]);
        return least;
    }
    glm::dvec3 center(const std::vector<glm::dvec4>& of) const {
        glm::dvec3 sum(0.0);
        double mass = 0.0;
        for (std::size_t n = 0; n < of.size(); ++n) {
            sum += static_cast<double>(model->masses[n]) * glm::dvec3(of[n]);
            mass += static_cast<double>(model->masses[n]);
        }
        return sum / mass;
    }
};

TEST(PlaneLanding, FlatBodiesGoStraightOut) {
    const Landing landing(1e9, 0.0, {0.03, 0.05});
    EXPECT_TRUE(landing.lands);
    for (std::size_t n = 0; n < landing.guess.size(); ++n)
        EXPECT_LT(glm::distance(landing.positions[n], landing.guess[n] + glm::dvec4(0.03, 0.05, 0.0, 0.0)),
                  5e-4)
            << n;
}

TEST(PlaneLanding, BodiesKeepTheirShapeAndTurnWhereACornerIsInTheWay) {
    const double depth = 0.05;
    const Landing landing(1e9, 0.3, {-1.0, depth});
    EXPECT_NEAR(landing.least(1), 0.0, 0.1 * depth);  // to first order in the rotation
    for (std::size_t a = 0; a < landing.guess.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_NEAR(glm::distance(landing.positions[a], landing.positions[b]),
                        glm::distance(landing.guess[a], landing.guess[b]), 1e-9);
    // A push at a lever r, with the radius of gyration k, moves the centre 1 / (1 + r^2 / k^2) as far as the
    // corner.
    const glm::dvec3 lifted = landing.center(landing.positions) - landing.center(landing.guess);
    EXPECT_NEAR(lifted.x, 0.0, 1e-9);
    EXPECT_GT(lifted.y, 0.3 * depth);
    EXPECT_LT(lifted.y, 0.8 * depth);
}

// A force of m / h^2 (y - x) presses the block where it has come by h^2 g in a step: Coulomb's force of the
// coefficient times that takes back so much of its slip.
TEST(PlaneLanding, FrictionTakesBackWhatItCan) {
    const double depth = 0.003, coefficient = 0.5;
    for (const double slid : {0.5, 0.98, 1.02, 3.0}) {
        const double slip = slid * coefficient * depth;
        const Landing landing(1e9, 0.0, {-1.0, depth}, slip * glm::normalize(glm::dvec3(1, 0, 2)),
                              coefficient);
        const glm::dvec3 back = landing.center(landing.positions) - landing.center(landing.guess);
        const double most = coefficient * depth;
        EXPECT_NEAR(glm::length(glm::dvec2(back.x, back.z)), std::min(slip, most), 0.01 * most) << slid;
        EXPECT_NEAR(glm::dot(back, glm::normalize(glm::dvec3(2, 0, -1))), 0.0, 0.01 * most) << slid;
        EXPECT_NEAR(landing.least(1), 0.0, 0.01 * depth) << slid;
    }
}

// A block that lies on a plane is pressed together already. So it stays where its weight leads it out of, and
// does not yield again as if it came down only now.
TEST(PlaneLanding, WhatLiesThereStays) {
    const double down = 0.003;  // h^2 g [m]
    for (const double youngs_modulus : {1e6, 1e8}) {
        const Landing guess(youngs_modulus, 0.0, {-1.0, down});
        const double part = guess.weight(down) / guess.lowest_count();
        const Landing landing(youngs_modulus, 0.0, {-1.0, down}, {}, 0.5, {0.0, -part, 0.0});
        const glm::dvec3 back = landing.center(landing.positions) - landing.center(landing.guess);
        EXPECT_LT(glm::distance(back, {0.0, down, 0.0}), 1e-3 * down) << youngs_modulus;
    }
}

// Rotations are large here, and the other end comes down.
TEST(PlaneLanding, AllNodesEndOutside) {
    for (const double angle : {-1.2, -0.5, -0.1, 0.02, 0.4, 0.8})
        for (const double depth : {0.01, 0.1, 0.2}) {
            const Landing landing(1e9, angle, {0.5 * depth, depth});
            EXPECT_GT(std::min(landing.least(0), landing.least(1)), -0.005 * depth) << angle << ' ' << depth;
        }
}

TEST(PlaneLanding, LeavesSoftBodiesAndThoseOutside) {
    const Landing soft(1e4, 0.3, {0.05, 0.05}), outside(1e9, 0.3, {-0.01, -0.01});
    EXPECT_FALSE(soft.lands);
    EXPECT_EQ(soft.positions, soft.guess);
    EXPECT_FALSE(outside.lands);
    EXPECT_EQ(outside.positions, outside.guess);
}

}  // namespace
}  // namespace gelatin
