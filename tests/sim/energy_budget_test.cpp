#include "sim/energy_budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_models.h"

namespace gelatin {
namespace {

// Two kilograms and a spring of 100 N/m, 2 m long: doubled it holds 200 J.
Model oscillator(double gravity) {
    test::Net net;
    net.positions = {{-1, 0, 0}, {1, 0, 0}, {5, 0, 0}};
    net.velocities.resize(3);
    net.masses = {1.0, 1.0, std::numeric_limits<double>::infinity()};
    net.springs = {{0, 1, 2.0f, 100.0f}};
    net.gravity = {0.0, -gravity, 0.0};
    return test::make_model(net);
}

TEST(EnergyBudget, WithoutGravityIsTenTimesStartAndAllowance) {
    const EnergyBudget budget(oscillator(0.0), {1.0, 50.0, 0.0});
    EXPECT_NEAR(budget.most_at(1.0), 10.0 * 250.0, 1e-6);
    EXPECT_NEAR(budget.most_at(1000.0), 10.0 * 250.0, 1e-6);
    EXPECT_NEAR(budget.most_for({5.0, 0.0, 0.0}), 10.0 * 250.0, 1e-6);
}

// Free fall, from rest or with gravity at its back, is what gives most: half of M (v + g t)^2.
TEST(EnergyBudget, FreeFallForTenMinutesIsWithinIt) {
    const double g = 9.81, mass = 2.0;
    for (const double speed : {0.0, 500.0}) {
        const double start = 0.5 * mass * speed * speed;
        const EnergyBudget budget(oscillator(g), {0.0, start, 0.0});
        for (const double time : {0.001, 1.0, 600.0}) {
            const double now = 0.5 * mass * std::pow(speed + g * time, 2);
            EXPECT_GE(budget.most_at(time), 10.0 * now);
            EXPECT_LE(budget.most_at(time), 10.001 * std::pow(std::sqrt(now) + std::sqrt(200.0), 2));
            EXPECT_NEAR(budget.most_for({time, now, start - now}), 10.0 * (now + 200.0), 1e-6 * now);
        }
    }
}

TEST(EnergyBudget, WhatGravityTakesIsNotGivenBack) {
    const EnergyBudget budget(oscillator(9.81), {0.0, 80.0, 100.0});
    EXPECT_NEAR(budget.most_for({1.0, 0.0, 170.0}), 10.0 * (80.0 + 200.0), 1e-4);
}

TEST(EnergyBudget, ALaterAccountNarrowsWhatASingleNodeMayHave) {
    EnergyBudget budget(oscillator(9.81), {0.0, 0.0, 0.0});
    const double before = budget.most_at(60.5);
    budget.note({60.0, 1.0, 0.0});
    EXPECT_LT(budget.most_at(60.5), 0.01 * before);
    EXPECT_GT(budget.most_at(60.5), 10.0 * (1.0 + 200.0));
}

// In the middle of an impact contacts hold all of it.
TEST(EnergyBudget, WhatContactsHoldComesBack) {
    EnergyBudget budget(oscillator(0.0), {0.0, 1e5, 0.0});
    budget.note({1.0, 0.3, 0.0});
    EXPECT_GE(budget.most_at(1.01), 10.0 * 1e5);
}

// A body without gravity, pulled by a force: half of (F t)^2 / M, measured at every frame or never.
TEST(EnergyBudget, LoadsMayGiveWhatTheyGiveAFreeBody) {
    Body block = test::make_body(test::make_block({2, 2, 2}, {1.0, 1.0, 1.0}));
    block.material.youngs_modulus = 1.0;  // [Pa]: hardly any allowance
    block.loads = {{HalfSpaceRegion{{1.0, 0.0, 0.0}, 2.0}, ForceLoad{{300.0, -400.0, 0.0}}}};
    const Model model = test::make_model(block);
    const double mass = model.objects[0].mass, allowance = 7.5 * 0.4;
    const auto energy = [&](double time) { return 0.5 * std::pow(500.0 * time, 2) / mass; };
    for (const int frames : {1, 50}) {
        EnergyBudget budget(model, {0.0, 0.0, 0.0});
        for (int f = 1; f <= frames; ++f) {
            const double time = 100.0 * f / frames, now = energy(time);
            EXPECT_GE(budget.most_at(time), 10.0 * now);
            EXPECT_GE(budget.most_for({time, now, 0.0}), 10.0 * now);
            EXPECT_LE(budget.most_for({time, now, 0.0}), 10.0 * (2.2 * now + 10.0 * allowance));
            budget.note({time, now, 0.0});
            EXPECT_EQ(budget.time(), time);
        }
    }
}

// A pressure on one side of a closed box, of 1 m^2: at most four times its force.
TEST(EnergyBudget, PressuresCountByArea) {
    const auto drive = [](const LoadDescription& load) {
        Body block = test::make_body(test::make_block({3, 3, 3}, {1.0, 1.0, 1.0}));
        block.material.youngs_modulus = 1e-3;  // [Pa]
        block.loads = {load};
        const EnergyBudget budget(test::make_model(block), {0.0, 0.0, 0.0});
        return std::sqrt(budget.most_at(1.0) / 10.0);
    };
    const Region side = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01};
    const double pressed = drive({side, PressureLoad{1e4}}),
                 pulled = drive({side, TractionLoad{{1e4, 0, 0}}});
    EXPECT_NEAR(pressed / pulled, 4.0, 0.01);
}

TEST(EnergyBudget, NeoHookeanBodiesHaveAnAllowanceToo) {
    Material material;
    material.model = MaterialModel::neo_hookean;
    const Model model = test::make_model(test::make_body(test::make_block({2, 2, 2}, {1, 1, 1}), material));
    const EnergyBudget budget(model, {0.0, 0.0, 0.0});
    EXPECT_GT(budget.most_for({1.0, 0.0, 0.0}), material.youngs_modulus);
}

TEST(EnergyBudget, StartsAnew) {
    EnergyBudget budget(oscillator(0.0), {0.0, 1.0, 0.0});
    budget.restart({2.0, 500.0, 30.0});
    EXPECT_EQ(budget.time(), 2.0);
    EXPECT_NEAR(budget.most_for({3.0, 0.0, 30.0}), 10.0 * 700.0, 1e-6);
}

}  // namespace
}  // namespace gelatin
