#include "cpu/implicit/energy_account.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "support/contact_scenes.h"

namespace gelatin {
namespace {

using Nodes = cpu::Nodes<double>;

// Two blocks that turn and vibrate, far from each other, without gravity.
class EnergyAccountTest : public testing::Test {
protected:
    EnergyAccountTest() {
        model_ = test::make_blocks({{}, {.place = {1, 0, 0}}});
        start_.positions.assign(model_->positions.begin(), model_->positions.end());
        for (const glm::dvec4& p : start_.positions)
            start_.velocities.push_back(
                glm::dvec4(1.0 - p.y, p.x, 0.2 * std::sin(40.0 * p.x) * std::cos(30.0 * p.y), 0.0));
        account_ = std::make_unique<cpu::EnergyAccount<double>>(model_);
        displacements_.assign(model_->node_count(), glm::dvec3(0.0));
    }

    // The two touch, without pressing each other.
    void join() {
        cpu::ContactRow<double> row;
        row.other = 1;
        rows_ = {row};
    }
    // A step that nothing but velocities change in.
    double measure(const Nodes& previous, const Nodes& current) {
        islands_.find<double>(*model_, rows_, previous, !loads_.empty());
        account_->begin(previous);
        return account_->measure({0.01, loads_, nullptr, {}, rows_, displacements_, islands_, previous, current});
    }
    Nodes times(const Nodes& nodes, double factor, std::size_t body) const {
        Nodes changed = nodes;
        const Range& range = model_->objects[body].nodes;
        for (std::uint32_t n = range.first; n < range.end(); ++n) changed.velocities[n] *= factor;
        return changed;
    }
    test::BodySums sums(const Nodes& nodes) const { return test::sum_bodies<double>(*model_, nodes); }
    double energy(const Nodes& nodes) const { return sums(nodes).kinetic; }

    std::shared_ptr<const Model> model_;
    std::unique_ptr<cpu::EnergyAccount<double>> account_;
    std::vector<glm::dvec4> loads_;
    std::vector<glm::dvec3> displacements_;
    std::vector<cpu::ContactRow<double>> rows_;
    cpu::Islands islands_;
    Nodes start_;
};

// Within 0.2% of what was there.
TEST_F(EnergyAccountTest, WhatABodyGainsItsVibrationsLose) {
    Nodes now = times(start_, 1.01, 0);
    ASSERT_GT(energy(now), 1.005 * energy(start_));
    EXPECT_EQ(measure(start_, now), 0.0);
    const test::BodySums gained = sums(now);
    account_->settle(islands_, now);
    EXPECT_NEAR(energy(now), energy(start_), 0.002 * energy(start_));
    EXPECT_LT(glm::length(sums(now).momentum - gained.momentum), 1e-12);
    const auto angular = [&](const Nodes& nodes) {
        glm::dvec3 sum(0.0);
        for (std::size_t n = 0; n < nodes.positions.size(); ++n)
            sum += glm::cross(glm::dvec3(nodes.positions[n]), glm::dvec3(nodes.velocities[n])) /
                   nodes.positions[n].w;
        return sum;
    };
    Nodes before = times(start_, 1.01, 0);
    EXPECT_LT(glm::length(angular(now) - angular(before)), 1e-6);
    // Of the other body nothing was taken.
    const Range& other = model_->objects[1].nodes;
    for (std::uint32_t n = other.first; n < other.end(); ++n)
        EXPECT_EQ(now.velocities[n], start_.velocities[n]);
}

TEST_F(EnergyAccountTest, WhatCannotBeTakenIsOwed) {
    for (std::size_t n = 0; n < start_.velocities.size(); ++n) start_.velocities[n] = {1, 0, 0, 0};
    join();
    Nodes now = times(start_, 1.1, 0);  // of what they move beside each other, at the start nothing
    const double gain = energy(now) - energy(start_);
    EXPECT_GT(measure(start_, now), 0.99);
    account_->settle(islands_, now);
    EXPECT_EQ(energy(now), energy(times(start_, 1.1, 0)));
    // Until they vibrate.
    Nodes shaken = now;
    for (std::uint32_t n = 0; n < model_->body_node_count(); ++n)
        shaken.velocities[n].z = n % 2 == 0 ? 2.0 : -2.0;
    account_->change();
    const double before = energy(shaken);
    EXPECT_EQ(measure(shaken, shaken), 0.0);
    account_->settle(islands_, shaken);
    EXPECT_LT(energy(shaken), before - gain + 0.003 * before);
}

TEST_F(EnergyAccountTest, LoadsWork) {
    Nodes now = times(start_, 1.2, 0);
    const double gain = energy(now) - energy(start_);
    const std::uint32_t node = model_->objects[0].nodes.first;
    loads_.assign(model_->node_count(), glm::dvec4(0.0));
    loads_[node] = {0, 100, 0, 0};
    displacements_[node] = {0, gain / 100.0, 0};
    EXPECT_EQ(measure(start_, now), 0.0);
    const Nodes before = now;
    account_->settle(islands_, now);
    EXPECT_EQ(now.velocities, before.velocities);
    displacements_[node] = {0, 0.5 * gain / 100.0, 0};
    measure(start_, now);
    account_->settle(islands_, now);
    EXPECT_LT(energy(now), energy(before));
}

// Bodies that touch are one: what one gains the other may have lost.
TEST_F(EnergyAccountTest, IsKeptByIsland) {
    for (std::size_t n = 0; n < start_.velocities.size(); ++n) start_.velocities[n] = {1, 0, 0, 0};
    const Nodes now = times(times(start_, 1.1, 0), 0.8, 1);
    EXPECT_GT(measure(start_, now), 0.1);
    join();
    EXPECT_EQ(measure(start_, now), 0.0);
}

TEST_F(EnergyAccountTest, SeesWhatIsNotFinite) {
    Nodes now = start_;
    now.velocities[0].x = std::nan("");
    EXPECT_TRUE(std::isinf(measure(start_, now)));
}

}  // namespace
}  // namespace gelatin
