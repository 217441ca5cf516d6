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

// Two blocks far from each other, without gravity.
class EnergyAccountTest : public testing::Test {
protected:
    EnergyAccountTest() {
        model_ = test::make_blocks({{}, {.place = {1, 0, 0}}});
        account_ = std::make_unique<cpu::EnergyAccount<double>>(model_);
        displacements_.assign(model_->node_count(), glm::dvec3(0.0));
    }

    // Both turn where they are, at some rate each [rad/s], and vibrate [m/s].
    Nodes turning(double first, double second, double vibrating) const {
        Nodes nodes;
        nodes.positions.assign(model_->positions.begin(), model_->positions.end());
        nodes.velocities.resize(nodes.positions.size());
        for (const std::size_t o : {0, 1}) {
            const Range& range = model_->objects[o].nodes;
            glm::dvec3 center(0.0);
            for (std::uint32_t n = range.first; n < range.end(); ++n)
                center += glm::dvec3(nodes.positions[n]) / nodes.positions[n].w / model_->objects[o].mass;
            for (std::uint32_t n = range.first; n < range.end(); ++n) {
                const glm::dvec3 arm = glm::dvec3(nodes.positions[n]) - center;
                nodes.velocities[n] =
                    glm::dvec4((o == 0 ? first : second) * glm::cross(glm::dvec3(0, 0, 1), arm) +
                                   glm::dvec3(0, 0, vibrating * arm.x * arm.y / 0.01),
                               0.0);
            }
        }
        return nodes;
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
        return account_->measure(
            {0.01, loads_, nullptr, {}, rows_, displacements_, islands_, asleep_, previous, current});
    }
    test::BodySums sums(const Nodes& nodes) const { return test::sum_bodies<double>(*model_, nodes); }
    double energy(const Nodes& nodes) const { return sums(nodes).kinetic; }

    std::shared_ptr<const Model> model_;
    std::unique_ptr<cpu::EnergyAccount<double>> account_;
    std::vector<glm::dvec4> loads_;
    std::vector<glm::dvec3> displacements_;
    std::vector<cpu::ContactRow<double>> rows_;
    cpu::Islands islands_;
    std::vector<std::uint8_t> asleep_ = std::vector<std::uint8_t>(8);  // none
};

// Within 0.2% of what was there. Of the other body nothing is taken.
TEST_F(EnergyAccountTest, WhatABodyGainsItsVibrationsLose) {
    const Nodes start = turning(1, 1, 0.2), end = turning(1.05, 1, 0.2);
    Nodes now = end;
    ASSERT_GT(energy(now), 1.01 * energy(start));
    EXPECT_EQ(measure(start, now), 0.0);
    account_->settle(islands_, now);
    EXPECT_NEAR(energy(now), energy(start), 0.002 * energy(start));
    EXPECT_LT(glm::length(sums(now).momentum - sums(end).momentum), 1e-12);
    glm::dvec3 turned(0.0);
    for (std::size_t n = 0; n < now.positions.size(); ++n)
        turned +=
            glm::cross(glm::dvec3(now.positions[n]), glm::dvec3(now.velocities[n] - end.velocities[n])) /
            now.positions[n].w;
    EXPECT_LT(glm::length(turned), 1e-6);
    const Range& other = model_->objects[1].nodes;
    for (std::uint32_t n = other.first; n < other.end(); ++n) EXPECT_EQ(now.velocities[n], end.velocities[n]);
}

TEST_F(EnergyAccountTest, WhatCannotBeTakenIsOwed) {
    const Nodes start = turning(1, 1, 0), end = turning(1.1, 1, 0);
    Nodes now = end;
    EXPECT_NEAR(measure(start, now), 1.0 - 1.0 / (1.1 * 1.1), 0.003);
    account_->settle(islands_, now);
    EXPECT_NEAR(energy(now), energy(end), 1e-5);
    // Until the body vibrates.
    Nodes shaken = turning(1.1, 1, 0.5);
    const double before = energy(shaken);
    account_->change();
    EXPECT_EQ(measure(shaken, shaken), 0.0);
    account_->settle(islands_, shaken);
    const double gain = energy(end) - energy(start);
    EXPECT_NEAR(energy(shaken), before - gain, 0.002 * before);
}

TEST_F(EnergyAccountTest, LoadsWork) {
    const Nodes start = turning(1, 1, 0.5), end = turning(1.2, 1, 0.5);
    const double gain = energy(end) - energy(start);
    loads_.assign(model_->node_count(), glm::dvec4(0.0));
    loads_[0] = {0, 100, 0, 0};
    for (const double part : {1.0, 0.5}) {
        displacements_[0] = {0, part * gain / 100.0, 0};
        Nodes now = end;
        measure(start, now);
        account_->settle(islands_, now);
        EXPECT_NEAR(energy(now), energy(start) + part * gain, 0.002 * energy(start)) << part;
        account_->forget();
    }
}

// Bodies that touch are one: what one gains the other may have lost.
TEST_F(EnergyAccountTest, IsKeptByIsland) {
    const Nodes start = turning(1, 1, 0), now = turning(1.1, 0.8, 0);
    EXPECT_GT(measure(start, now), 0.1);
    join();
    EXPECT_EQ(measure(start, now), 0.0);
}

// What falls fast has the same vibrations.
TEST_F(EnergyAccountTest, DoesNotDependOnHowFastAllMoves) {
    Nodes start = turning(1, 1, 0), now = turning(1.1, 1, 0);
    const double gained = measure(start, now);
    for (Nodes* nodes : {&start, &now})
        for (glm::dvec4& v : nodes->velocities) v.y -= 50.0;
    account_->forget();
    EXPECT_NEAR(measure(start, now), gained, 1e-2);
}

TEST_F(EnergyAccountTest, SeesWhatIsNotFinite) {
    const Nodes start = turning(1, 1, 0);
    Nodes now = start;
    now.velocities[0].x = std::nan("");
    EXPECT_TRUE(std::isinf(measure(start, now)));
}

}  // namespace
}  // namespace gelatin
