#include "cpu/descent/energy_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/descent/implicit_solver.h"
#include "cpu/elasticity/elastic_energy.h"
#include "cpu/measure/measure.h"
#include "support/contact_scenes.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

using test::kFrame;

// Of all bodies [J].
template <class Real>
double all_energy(const Model& model, const cpu::Nodes<Real>& nodes) {
    const test::BodySums sums = test::sum_bodies(model, nodes);
    return sums.sum() + sums.elastic;
}

// Violent scenes at random with the default of sweeps and of divided steps: after no step there is more
// energy than at the start, but for a part of the motion.
// @param most_bodies as of violent_blocks
void expect_no_gain(unsigned first, unsigned count, int most_bodies, double most_part) {
    for (unsigned seed = first; seed < first + count; ++seed) {
        test::RandomMaker random(seed);
        const auto model = make_blocks(test::violent_blocks(random, most_bodies), {0, -9.81, 0});
        cpu::ImplicitSolver<float> solver = test::make_solver<float>(model, 0.4, 10, true);
        const double start = all_energy(*model, solver.nodes()),
                     kinetic = test::sum_bodies(*model, solver.nodes()).kinetic;
        double most = start;
        for (int frame = 0; frame < 60; ++frame) {
            solver.advance({kFrame});
            most = std::max(most, all_energy(*model, solver.nodes()));
        }
        EXPECT_LE(most, start + most_part * kinetic) << "scene " << seed;
    }
}

TEST(EnergyBound, KeepsBodiesThatMeetFromGainingAny) {
    expect_no_gain(100, 3, 5, 1e-3);
}

TEST(EnergyBoundHeavy, KeepsBodiesThatMeetFromGainingAny) {
    expect_no_gain(103, 9, 5, 1e-3);
    expect_no_gain(100, 4, 10, 1e-3);
}

TEST(EnergyBoundLong, KeepsBodiesThatMeetFromGainingAny) {
    expect_no_gain(112, 288, 5, 5e-3);
}

// A step of two blocks apart from each other, which nothing but this test has made.
class EnergyBoundOfAStep : public testing::Test {
protected:
    using Positions = std::vector<glm::dvec4>;

    EnergyBoundOfAStep()
        : model_(test::make_blocks({{}, {.place = {0.8, 0, 0}}}, {0, -9.81, 0})),
          contacts_(model_, CollisionSettings{.response = CollisionResponse::contact}),
          bound_(model_),
          nodes_{Positions(model_->positions.begin(), model_->positions.end()),
                 Positions(model_->node_count(), glm::dvec4(0.0))},
          starts_(nodes_.positions) {
        for (std::size_t n = 0; n < starts_.size(); ++n)
            nodes_.velocities[n] = glm::dvec4(1.0, 0.0, 0.3, 0.0);
    }

    void begin(std::span<const std::uint32_t> pulled = {}) {
        contacts_.are_apart(kStep, nodes_, nullptr);
        bound_.begin({kStep, nodes_, starts_, {}, pulled}, contacts_);
    }

    // Where the step leads if each node goes on, and the first body grows on the way by a part of its
    // lengths.
    Positions grown(double part) const {
        glm::dvec3 center(0.0);  // of its mass
        const ModelObject& body = model_->objects[0];
        for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); ++n)
            center += static_cast<double>(model_->masses[n]) / body.mass * glm::dvec3(starts_[n]);
        Positions ends = starts_;
        for (std::size_t n = 0; n < ends.size(); ++n) {
            ends[n] += kStep * glm::dvec4(glm::dvec3(nodes_.velocities[n]), 0.0);
            if (n < body.nodes.end()) ends[n] += part * glm::dvec4(glm::dvec3(starts_[n]) - center, 0.0);
        }
        return ends;
    }

    double energy(std::uint32_t object, const Positions& positions, const Positions& velocities) const {
        const ModelObject& own = model_->objects[object];
        double sum = cpu::body_energy<double>(*model_, own, positions);
        for (std::uint32_t n = own.nodes.first; n < own.nodes.end(); ++n) {
            const glm::dvec3 v(velocities[n]);
            sum += static_cast<double>(model_->masses[n]) * (0.5 * glm::dot(v, v) + 9.81 * positions[n].y);
        }
        return sum;
    }
    Positions velocities_of(const Positions& ends) const {
        Positions velocities = ends;
        for (std::size_t n = 0; n < ends.size(); ++n)
            velocities[n] = glm::dvec4(glm::dvec3(ends[n] - starts_[n]) / kStep, 0.0);
        return velocities;
    }
    struct Momenta {
        glm::dvec3 linear{0.0}, angular{0.0};
    };
    // @param about the origin, with the nodes at `positions`
    Momenta momenta(const Positions& positions, const Positions& velocities) const {
        Momenta sums;
        const Range& nodes = model_->objects[0].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 own = static_cast<double>(model_->masses[n]) * glm::dvec3(velocities[n]);
            sums.linear += own;
            sums.angular += glm::cross(glm::dvec3(positions[n]), own);
        }
        return sums;
    }

    static constexpr double kStep = 0.01;
    std::shared_ptr<const Model> model_;
    cpu::Contacts<double> contacts_;
    cpu::EnergyBound<double> bound_;
    cpu::Nodes<double> nodes_;
    Positions starts_, ends_;
};

TEST_F(EnergyBoundOfAStep, TakesWhatDeformsABodyTooMuch) {
    begin();
    const Positions far = grown(0.05);
    bound_.measure(far);
    ASSERT_TRUE(bound_.plan(nullptr, far, ends_));
    const double before = energy(0, starts_, nodes_.velocities);
    ASSERT_GT(energy(0, far, velocities_of(far)), 1.5 * before);
    const double after = energy(0, ends_, velocities_of(ends_));
    EXPECT_LE(after, before + 0.5 * 27.0 * 9.81 * kStep * 9.81 * kStep + 2e-4 * before);
    EXPECT_GT(after, 0.9 * before);  // no more than that
    const Range& other = model_->objects[1].nodes;
    EXPECT_TRUE(
        std::equal(far.begin() + other.first, far.begin() + other.end(), ends_.begin() + other.first));
    const Momenta of_far = momenta(far, velocities_of(far)), of_end = momenta(far, velocities_of(ends_));
    EXPECT_LT(glm::length(of_end.linear - of_far.linear), 1e-9 * glm::length(of_far.linear));
    EXPECT_LT(glm::length(of_end.angular - of_far.angular), 1e-9 * glm::length(of_far.angular));
    bound_.measure(ends_);
    EXPECT_FALSE(bound_.plan(nullptr, ends_, ends_));
}

TEST_F(EnergyBoundOfAStep, LeavesWhatHasNoMore) {
    begin();
    const Positions near = grown(0.0);
    bound_.measure(near);
    EXPECT_FALSE(bound_.plan(nullptr, near, ends_));
    Positions velocities = velocities_of(near);
    const Positions as_they_were = velocities;
    bound_.end(nullptr, near, velocities);
    EXPECT_TRUE(velocities == as_they_were);
}

TEST_F(EnergyBoundOfAStep, KnowsNothingOfWhatAHandHolds) {
    const std::uint32_t pulled = model_->objects[0].nodes.first + 3;
    begin(std::span(&pulled, 1));
    const Positions far = grown(0.05);
    bound_.measure(far);
    EXPECT_FALSE(bound_.plan(nullptr, far, ends_));
}

// Where it cannot go back, it is slowed down; to no less than it had, and nothing else of it changes.
TEST_F(EnergyBoundOfAStep, SlowsDownWhatStaysDeformed) {
    begin();
    const Positions far = grown(0.05);
    bound_.measure(far);
    Positions velocities = velocities_of(far);
    const Momenta before = momenta(far, velocities);
    bound_.end(nullptr, far, velocities);
    const Momenta after = momenta(far, velocities);
    EXPECT_LT(glm::length(after.linear - before.linear), 1e-9 * glm::length(before.linear));
    EXPECT_LT(glm::length(after.angular - before.angular), 2e-6 * glm::length(before.angular));
    const auto kinetic = [&](const Positions& of) {
        double sum = 0.0;
        const Range& nodes = model_->objects[0].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sum +=
                0.5 * static_cast<double>(model_->masses[n]) * glm::dot(glm::dvec3(of[n]), glm::dvec3(of[n]));
        return sum;
    };
    ASSERT_GT(kinetic(velocities_of(far)), 1.1 * kinetic(nodes_.velocities));
    EXPECT_NEAR(kinetic(velocities), kinetic(nodes_.velocities), 1e-6 * kinetic(velocities));
}

// What the first part of a step lost the second one may bring back, but no later step.
TEST_F(EnergyBoundOfAStep, PartsOfAStepMayBringBackWhatTheyLost) {
    const auto make_step = [&](double slower) {
        begin();
        Positions ends = starts_;
        for (std::size_t n = 0; n < ends.size(); ++n)
            ends[n] += slower * kStep * glm::dvec4(glm::dvec3(nodes_.velocities[n]), 0.0);
        bound_.measure(ends);
        Positions velocities = velocities_of(ends);
        bound_.end(nullptr, ends, velocities);
        nodes_ = {ends, velocities};
        starts_ = ends;
    };
    const auto gains = [&] {
        begin();
        const Positions faster = grown(0.01);
        bound_.measure(faster);
        return bound_.plan(nullptr, faster, ends_);
    };
    ASSERT_TRUE(gains());
    bound_.begin_parts(contacts_);
    make_step(0.7);
    EXPECT_FALSE(gains());
    bound_.begin_parts(contacts_);  // contacts hold nothing
    EXPECT_TRUE(gains());
}

// Too little to go back for it, but the next step may have that much less.
TEST_F(EnergyBoundOfAStep, LittleIsOwed) {
    std::vector<glm::dvec4> velocities = nodes_.velocities;
    for (glm::dvec4& v : velocities) v *= 10.0;  // by much more than gravity adds in a step
    nodes_.velocities = velocities;
    const auto gains = [&] {
        begin();
        Positions ends = grown(1e-5);
        for (std::size_t n = 0; n < ends.size(); ++n)
            ends[n] += 0.0004 * kStep * glm::dvec4(glm::dvec3(velocities[n]), 0.0);
        bound_.measure(ends);
        const bool goes_back = bound_.plan(nullptr, ends, ends_);
        Positions after = velocities_of(ends);
        bound_.end(nullptr, ends, after);
        nodes_ = {ends, velocities};
        starts_ = ends;
        return goes_back;
    };
    EXPECT_FALSE(gains());
    EXPECT_TRUE(gains());
}

}  // namespace
}  // namespace gelatin
