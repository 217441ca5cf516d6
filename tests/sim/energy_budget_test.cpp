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

}  // namespace
}  // namespace gelatin
