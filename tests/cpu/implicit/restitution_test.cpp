// Restitution: what elasticity does not give back, bodies get as rigid ones.
#include "cpu/implicit/restitution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "cpu/implicit/system_solver.h"
#include "support/contact_scenes.h"

namespace gelatin {
namespace {

using test::Block;
using test::kFrame;
using test::make_blocks;
using Solver = cpu::SystemSolver<double>;

constexpr double kStiff = 1e8;  // [Pa]

Solver make_solver(const std::shared_ptr<const Model>& model, double restitution, bool divides_steps = false,
                   double friction = 0.0) {
    return Solver(
        model,
        CollisionSettings{
            .response = CollisionResponse::contact, .friction = friction, .restitution = restitution},
        ImplicitSettings{.divides_steps = divides_steps});
}

struct Sums {
    double mass = 0.0, energy = 0.0;                  // [kg], [J]
    glm::dvec3 momentum{0.0}, angular_momentum{0.0};  // about the origin
    glm::dvec3 velocity() const { return momentum / mass; }
};

Sums sums_of(const Model& model, Solver& solver, const Range& nodes) {
    Sums sums;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const auto mass = static_cast<double>(model.masses[n]);
        const glm::dvec3 velocity(solver.nodes().velocities[n]), position(solver.nodes().positions[n]);
        sums.mass += mass;
        sums.momentum += mass * velocity;
        sums.angular_momentum += mass * glm::cross(position, velocity);
        sums.energy += 0.5 * mass * glm::dot(velocity, velocity);
    }
    return sums;
}

Sums sums_of(const Model& model, Solver& solver, std::size_t object) {
    return sums_of(model, solver, model.objects[object].nodes);
}

Sums sums_of_all(const Model& model, Solver& solver) {
    return sums_of(model, solver, {0, model.body_node_count()});
}

// The y that the second of two blocks gains over the first, which is below it, after some frames.
double speed_apart(const std::vector<Block>& blocks, double restitution, int frames = 12,
                   int steps_a_frame = 1, bool divides_steps = false) {
    const auto model = make_blocks(blocks);
    Solver solver = make_solver(model, restitution, divides_steps);
    for (int step = 0; step < frames * steps_a_frame; ++step) solver.advance({kFrame / steps_a_frame});
    return sums_of(*model, solver, 1).velocity().y - sums_of(*model, solver, 0).velocity().y;
}

std::vector<Block> two_blocks(double youngs_modulus, double beside = 0.0) {
    return {{.velocity = {0, 1, 0}, .youngs_modulus = youngs_modulus},
            {.place = {beside, 0.38, 0}, .velocity = {0, -2, 0}, .youngs_modulus = youngs_modulus}};
}

TEST(Restitution, StiffBodiesLeaveWithThatPartOfTheirSpeed) {
    for (const double restitution : {0.0, 0.3, 0.7, 1.0})
        EXPECT_NEAR(speed_apart(two_blocks(kStiff), restitution), 3.0 * restitution, 0.03) << restitution;
}

TEST(Restitution, AllOfManyPairsDo) {
    std::vector<Block> blocks;
    for (int k = 0; k < 40; ++k) {
        for (Block block : two_blocks(kStiff)) {
            block.place.x = k;
            block.cells = {2, 2, 2};
            blocks.push_back(block);
        }
    }
    const auto model = make_blocks(blocks);
    Solver solver = make_solver(model, 0.7);
    for (int frame = 0; frame < 12; ++frame) solver.advance({kFrame});
    for (std::size_t o = 0; o < blocks.size(); o += 2) {
        const auto velocity = [&](std::size_t object) {
            return sums_of(*model, solver, object).velocity().y;
        };
        EXPECT_NEAR(velocity(o + 1) - velocity(o), 0.7 * 3.0, 0.1) << o;  // contacts press on while they part
    }
}

// In steps that are divided as they need it.
TEST(Restitution, FastStiffBodiesLeaveEachOther) {
    for (const double speed : {10.0, 100.0}) {
        std::vector<Block> blocks = two_blocks(10.0 * kStiff, 0.05);
        blocks[0].velocity = {0, speed, 0};
        blocks[1].velocity = {0, -speed, 0};
        const double apart = speed_apart(blocks, 0.3, 4, 1, true) / (2.0 * speed);
        EXPECT_GT(apart, 0.05) << speed;  // they turn
        EXPECT_LT(apart, 0.5) << speed;
    }
}

// Their impacts take long, and elasticity gives them back what they have.
TEST(Restitution, SoftBodiesBounceByThemselves) {
    const auto blocks = two_blocks(3e4);
    const double alone = speed_apart(blocks, 0.0, 30);
    EXPECT_GT(alone, 0.2 * 3.0);
    EXPECT_EQ(speed_apart(blocks, 1.0, 30), alone);
}

// In short steps their surfaces bounce before the bodies do: they leave each other for single steps, in which
// the bodies still approach.
TEST(RestitutionHeavy, ShortStepsSeeHowSoftBodiesBounce) {
    const std::vector<Block> blocks = two_blocks(3e4, 0.12);
    const double alone = speed_apart(blocks, 0.0, 4, 128);
    EXPECT_GT(alone, -2.0) << "they have met";
    EXPECT_EQ(speed_apart(blocks, 1.0, 4, 128), alone);
}

// Three that meet off their middles: they spin.
std::vector<Block> tumbling_blocks() {
    std::vector<Block> blocks = two_blocks(kStiff, 0.21);
    blocks.push_back({.place = {-0.2, 0.8, 0.05}, .velocity = {0, -6, 1}, .youngs_modulus = kStiff});
    return blocks;
}

// Without it, positions are the same up to the first step with an impact that is over.
TEST(Restitution, KeepsMomentumAndAngularMomentum) {
    const auto model = make_blocks(tumbling_blocks());
    Solver solver = make_solver(model, 1.0), without = make_solver(model, 0.0);
    const auto momentum = [&](Solver& of) { return sums_of_all(*model, of).momentum; };
    const auto angular = [&](Solver& of) { return sums_of_all(*model, of).angular_momentum; };
    const double size = 27.0 * 6.0;  // of a momentum [kg m/s]; arms are shorter than 1 m
    for (int k = 0; k < 240 && solver.nodes().velocities == without.nodes().velocities; ++k) {
        solver.advance({kFrame / 4.0});
        without.advance({kFrame / 4.0});
    }
    ASSERT_EQ(solver.nodes().positions, without.nodes().positions);
    EXPECT_GT(glm::length(sums_of(*model, solver, 0).momentum - sums_of(*model, without, 0).momentum),
              0.05 * size);
    EXPECT_LT(glm::length(momentum(solver) - momentum(without)),
              1e-8 * size);  // masses are of single precision
    EXPECT_LT(glm::length(angular(solver) - angular(without)), 1e-6 * size);
}

TEST(Restitution, AddsNoEnergyToWhatWasThereBefore) {
    for (const double restitution : {0.3, 1.0}) {
        const auto model = make_blocks(tumbling_blocks());
        Solver solver = make_solver(model, restitution);
        const double before = sums_of_all(*model, solver).energy;
        for (int frame = 0; frame < 30; ++frame) {
            solver.advance({kFrame});
            EXPECT_LT(sums_of_all(*model, solver).energy, 1.01 * before) << restitution;  // to kEnough
        }
    }
}

ColliderDescription table(double restitution) {
    ColliderDescription description;
    description.shape = Shape{BoxShape{{4, 1, 4}}};
    description.position = {0, -0.5, 0};
    description.restitution = restitution;
    return description;
}

// Of the collider, whatever the bodies' is.
TEST(Restitution, CollidersHaveTheirOwn) {
    ColliderDescription plane;
    plane.restitution = 0.6;
    for (const ColliderDescription& collider : {plane, table(0.6)}) {
        const auto model = make_blocks(
            {{.place = {0, 0.05, 0}, .velocity = {0, -2, 0}, .youngs_modulus = kStiff}, {.place = {3, 5, 0}}},
            {}, {collider});
        Solver solver = make_solver(model, 0.1);
        for (int frame = 0; frame < 6; ++frame) solver.advance({kFrame});
        EXPECT_NEAR(sums_of(*model, solver, 0).velocity().y, 1.2, 0.02);
    }
}

// A table that rises at 1 m/s throws a block up at twice its speed.
TEST(Restitution, CollidersThrow) {
    ColliderDescription collider = table(1.0);
    collider.keyframes = {{.time = 0.0, .move = {0, 0, 0}}, {.time = 1.0, .move = {0, 1, 0}}};
    const auto model = make_blocks({{.place = {0, 0.1, 0}, .youngs_modulus = kStiff}}, {}, {collider});
    Solver solver = make_solver(model, 0.0);
    for (int frame = 0; frame < 12; ++frame) test::advance(solver, *model, frame);
    EXPECT_NEAR(sums_of(*model, solver, 0).velocity().y, 2.0, 0.05);
}

// Gravity makes what rests approach in every step.
TEST(RestitutionHeavy, WhatRestsDoesNotBounce) {
    const auto model = make_blocks(
        {{.place = {0, 0.012, 0}, .youngs_modulus = 1e6}, {.place = {0.02, 0.325, 0}, .youngs_modulus = 1e6}},
        {0, -9.81, 0}, {table(0.5)});
    Solver solver = make_solver(model, 0.5, false, 0.4);
    for (int frame = 0; frame < 240; ++frame) solver.advance({kFrame});
    const Sums sums = sums_of_all(*model, solver);
    EXPECT_LT(sums.energy / sums.mass, 1e-8);
}

TEST(Restitution, ForgetsWhatHasMetAtARestart) {
    const auto model = make_blocks(two_blocks(3e4));
    Solver solver = make_solver(model, 1.0), fresh = make_solver(model, 1.0);
    for (int frame = 0; frame < 6; ++frame) solver.advance({kFrame});  // they press each other
    for (Solver* each : {&solver, &fresh}) {
        each->write_state({model->positions, model->velocities, {}});
        for (int frame = 0; frame < 3; ++frame) each->advance({kFrame});
    }
    EXPECT_EQ(solver.nodes().velocities, fresh.nodes().velocities);
}

}  // namespace
}  // namespace gelatin
