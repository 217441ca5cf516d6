#include "cpu/implicit/time_scheme.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "support/contact_scenes.h"

namespace gelatin {
namespace {

// All nodes of a block on springs of their own to where they are at first, without gravity.
class Oscillators {
public:
    explicit Oscillators(double frequency)
        : frequency_(frequency),
          model_(test::make_blocks({test::Block{.cells = {1, 1, 1}}})),
          scheme_(model_) {
        nodes_.positions.assign(model_->positions.begin(), model_->positions.end());
        nodes_.velocities.assign(nodes_.positions.size(), glm::dvec4(0.0));
        start_ = nodes_.positions;
    }
    void displace(double by, double speed) {
        for (glm::dvec4& x : nodes_.positions) x.y += by;
        for (glm::dvec4& v : nodes_.velocities) v.y = speed;
    }
    // m / h'^2 (x' - y) = - m w^2 (x' - x_0)
    void advance(double step, bool by_euler) {
        scheme_.begin(nodes_);
        by_euler ? scheme_.set(0, step, 0.0) : scheme_.set_second_order(0, step);
        cpu::Nodes<double> next = nodes_;
        const double stiffness = std::pow(frequency_ * scheme_.of(0).step, 2);
        for (std::size_t n = 0; n < start_.size(); ++n) {
            const glm::dvec3 away(nodes_.positions[n] - start_[n]);
            const glm::dvec3 target = scheme_.target(nodes_, n, glm::dvec3(0.0));
            const glm::dvec3 moved = (target - stiffness * away) / (1.0 + stiffness);
            next.positions[n] += glm::dvec4(moved, 0.0);
            next.velocities[n] = glm::dvec4(scheme_.velocity(nodes_, n, moved), 0.0);
        }
        scheme_.end(nodes_, next);
        nodes_ = next;
    }
    double place() const { return nodes_.positions[0].y - start_[0].y; }
    double speed() const { return nodes_.velocities[0].y; }
    double amplitude() const { return std::hypot(place(), speed() / frequency_); }

private:
    double frequency_;
    std::shared_ptr<const Model> model_;
    cpu::TimeScheme<double> scheme_;
    cpu::Nodes<double> nodes_;
    std::vector<glm::dvec4> start_;
};

// From the first step on, which is by Euler's scheme, whose error is of the second order in one step.
double error_after_a_second(int steps) {
    Oscillators oscillators(3.0);
    oscillators.displace(0.0, 1.0);
    for (int s = 0; s < steps; ++s) oscillators.advance(1.0 / steps, s == 0);
    return std::abs(oscillators.place() - std::sin(3.0) / 3.0);
}

TEST(TimeScheme, IsOfTheSecondOrder) {
    EXPECT_NEAR(error_after_a_second(200) / error_after_a_second(400), 4.0, 0.3);
}

// docs/physics.md, "Numerical damping".
TEST(TimeScheme, HardlyDampsWhatAStepResolves) {
    Oscillators oscillators(1.0);
    oscillators.displace(1.0, 0.0);
    oscillators.advance(1.0, true);
    for (int s = 0; s < 20; ++s) oscillators.advance(1.0, false);
    const auto highest = [&] {  // in a period
        double most = 0.0;
        for (int s = 0; s < 7; ++s) {
            oscillators.advance(1.0, false);
            most = std::max(most, oscillators.amplitude());
        }
        return most;
    };
    const double first = highest();
    for (int s = 0; s < 63; ++s) oscillators.advance(1.0, false);
    EXPECT_NEAR(std::pow(highest() / first, 1.0 / 70.0), 0.985, 0.002);
}

// Of two vibrations that are alike one lasts: the other grows at first, as k 0.7^k.
TEST(TimeScheme, TakesThreeTenthsOfFastVibrationsInAStep) {
    Oscillators oscillators(1e5);
    oscillators.displace(0.0, 1.0);
    oscillators.advance(1.0, true);
    for (int s = 0; s < 60; ++s) oscillators.advance(1.0, false);
    for (int s = 0; s < 3; ++s) {
        const double before = oscillators.speed();
        oscillators.advance(1.0, false);
        EXPECT_NEAR(oscillators.speed() / before, -0.7, 0.03) << s;
    }
}

// A force that has acted for long is known; of the last step 0.43 is still to come when it ends.
TEST(TimeScheme, BringsAllOfAForce) {
    const auto model = test::make_blocks({test::Block{.cells = {1, 1, 1}}});
    cpu::TimeScheme<double> scheme(model);
    cpu::Nodes<double> nodes;
    nodes.positions.assign(model->positions.begin(), model->positions.end());
    nodes.velocities.assign(nodes.positions.size(), glm::dvec4(0.0));
    const auto advance = [&](double acceleration, bool by_euler) {
        scheme.begin(nodes);
        by_euler ? scheme.set(0, 0.1, 0.0) : scheme.set_second_order(0, 0.1);
        cpu::Nodes<double> next = nodes;
        for (std::size_t n = 0; n < nodes.positions.size(); ++n) {
            const glm::dvec3 moved = scheme.target(nodes, n, glm::dvec3(0.0, acceleration, 0.0));
            next.positions[n] += glm::dvec4(moved, 0.0);
            next.velocities[n] = glm::dvec4(scheme.velocity(nodes, n, moved), 0.0);
        }
        scheme.end(nodes, next);
        nodes = next;
    };
    for (int s = 0; s < 10; ++s) advance(2.0, s == 0);
    EXPECT_NEAR(nodes.velocities[0].y, 2.0, 1e-12);
    for (int s = 0; s < 30; ++s) advance(0.0, false);
    EXPECT_NEAR(nodes.velocities[0].y, 2.0 + 0.5 * 0.2, 0.02);
}

// Two blocks push each other, then part, and one of them goes on by Euler's scheme.
TEST(TimeScheme, BodiesThatPartKeepTheirMomentum) {
    const auto model = test::make_blocks({{}, {.place = {2, 0, 0}}});
    cpu::TimeScheme<double> scheme(model);
    cpu::RigidLevel<double> rigid(model);
    cpu::Nodes<double> nodes;
    nodes.positions.assign(model->positions.begin(), model->positions.end());
    nodes.velocities.assign(nodes.positions.size(), glm::dvec4(0.0));
    const std::uint32_t second = model->objects[1].nodes.first;
    const double step = 0.01;
    std::vector<double> inertia;
    for (const glm::dvec4& x : nodes.positions) inertia.push_back(1.0 / (x.w * step * step));
    // @return momentum of both in all [kg m/s]
    const auto advance = [&](std::array<bool, 2> by_euler, std::array<std::uint32_t, 2> islands,
                             double push) {
        scheme.begin(nodes);
        for (std::size_t o = 0; o < 2; ++o)
            by_euler[o] ? scheme.set(o, step, 0.0) : scheme.set_second_order(o, step);
        scheme.tie(islands, std::array<std::uint8_t, 2>{});
        std::vector<glm::dvec3> forces(nodes.positions.size(), glm::dvec3(0.0));
        forces[second - 1].x = -push;
        forces[second].x = push;
        rigid.begin(nodes.positions, inertia);
        cpu::Nodes<double> next = nodes;
        scheme.keep_momenta(rigid, std::array{0u, 1u}, forces, next);
        scheme.end(nodes, next);
        nodes = next;
        glm::dvec3 momentum(0.0);
        for (std::size_t n = 0; n < nodes.positions.size(); ++n)
            momentum += glm::dvec3(nodes.velocities[n]) / nodes.positions[n].w;
        return glm::length(momentum);
    };
    const double push = 10.0, rounding = 1e-12 * push * step;
    EXPECT_LT(advance({true, true}, {0, 0}, push), rounding);
    EXPECT_LT(advance({false, false}, {0, 0}, 2.0 * push), rounding);
    for (int k = 0; k < 4; ++k) EXPECT_LT(advance({false, k > 0}, {0, 1}, 0.0), rounding) << k;
    EXPECT_GT(std::abs(nodes.velocities[second].x), 0.0);
}

}  // namespace
}  // namespace gelatin
