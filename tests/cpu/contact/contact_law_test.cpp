#include "cpu/contact/contact_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>

#include "support/random_maker.h"

namespace gelatin {
namespace {

using V = cpu::Vec3<double>;
using Share = cpu::ContactShare<double>;
using Terms = cpu::NodeTerms<double>;

constexpr double kReach = 0.02, kStiffness = 500.0;

TEST(ContactLaw, ForceAndHessianAreThoseOfTheEnergy) {
    for (double gap = 1e-4; gap < 1.5 * kReach; gap *= 1.07) {
        const double h = 1e-6 * gap;
        const auto slope = [&](const auto& of) { return (of(gap + h) - of(gap - h)) / (2 * h); };
        const double force = cpu::contact_force(gap, kReach, kStiffness);
        EXPECT_NEAR(force, -slope([](double g) { return cpu::contact_energy(g, kReach, kStiffness); }),
                    1e-6 * (force + 1e-6));
        const double hessian = cpu::contact_hessian(gap, kReach, kStiffness);
        EXPECT_NEAR(hessian, -slope([](double g) { return cpu::contact_force(g, kReach, kStiffness); }),
                    1e-5 * (hessian + 1e-3));
    }
}

TEST(ContactLaw, IsContinuousAndEndsAtTheReach) {
    for (const double gap : {0.5 * kReach, kReach}) {
        const double below = gap * (1 - 1e-12), above = gap * (1 + 1e-12);
        EXPECT_NEAR(cpu::contact_energy(below, kReach, kStiffness),
                    cpu::contact_energy(above, kReach, kStiffness), 1e-9);
        EXPECT_NEAR(cpu::contact_force(below, kReach, kStiffness),
                    cpu::contact_force(above, kReach, kStiffness), 1e-9);
    }
    EXPECT_EQ(cpu::contact_energy(kReach, kReach, kStiffness), 0.0);
    EXPECT_EQ(cpu::contact_force(1.1 * kReach, kReach, kStiffness), 0.0);
    EXPECT_GT(cpu::contact_force(1e-3 * kReach, kReach, kStiffness), 200 * kStiffness * kReach);
}

struct Case {
    Share share;
    V displacement;
};

// Shares at all gaps, that stick and that slide.
Case random_case(test::RandomMaker& random) {
    const V towards = glm::normalize(random.point());
    V hold = random.point(2.0);
    hold -= glm::dot(hold, towards) * towards;
    const double share = random.uniform(0.05, 1.0);
    const Share made{towards,   random.magnitude(0.05 * kReach, 2 * kReach),
                     1 / share, random.magnitude(10.0, 1e3),
                     kReach,    hold,
                     0.4,       random.magnitude(0.1, 10.0)};
    return {made, random.point(0.02 * share * made.gap)};
}

Terms terms_of(const Share& share, const V& displacement) {
    Terms terms;
    cpu::add_contact_share(share, displacement, terms);
    cpu::add_friction_share(share, displacement, terms);
    return terms;
}

TEST(ContactLaw, AShareIsTheSlopeOfItsEnergy) {
    test::RandomMaker random(3);
    for (int i = 0; i < 300; ++i) {
        const Case one = random_case(random);
        const double h = 1e-6 * one.share.gap;
        const Terms terms = terms_of(one.share, one.displacement);
        for (int k = 0; k < 3; ++k) {
            V e(0);
            e[k] = h;
            const auto energy = [&](const V& d) { return cpu::contact_share_energy(one.share, d); };
            const double slope = (energy(one.displacement + e) - energy(one.displacement - e)) / (2 * h);
            EXPECT_NEAR(terms.force[k], -slope, 1e-4 * (glm::length(terms.force) + 0.1));
        }
    }
}

// But for the little that is kept along a slip.
TEST(ContactLaw, AShareHasTheSecondDerivativeOfItsEnergy) {
    test::RandomMaker random(4);
    int slides = 0;
    for (int i = 0; i < 300; ++i) {
        const Case one = random_case(random);
        const double h = 1e-5 * one.share.gap;
        const Terms terms = terms_of(one.share, one.displacement);
        const auto& diagonal = terms.hessian.diagonal;
        const double size = diagonal.x + diagonal.y + diagonal.z;
        const V direction = glm::normalize(random.point());
        const V change = (terms_of(one.share, one.displacement - h * direction).force -
                          terms_of(one.share, one.displacement + h * direction).force) /
                         (2 * h);
        const auto& b = terms.hessian.beside;
        const V product(diagonal.x * direction.x + b.z * direction.y + b.y * direction.z,
                        b.z * direction.x + diagonal.y * direction.y + b.x * direction.z,
                        b.y * direction.x + b.x * direction.y + diagonal.z * direction.z);
        const double kept = 0.01 * one.share.stiffness * one.share.inverse_share;
        EXPECT_LT(glm::length(change - product), 1.01 * kept + 1e-3 * size);
        slides += glm::length(one.share.hold_at(one.displacement)) > one.share.limit ? 1 : 0;
    }
    EXPECT_GT(slides, 50);
    EXPECT_LT(slides, 250);
}

// The sum of a pair's shares is nowhere less than its energy, and equal to it in value where it was aimed.
TEST(ContactLaw, SharesBoundTheEnergyOfThePair) {
    test::RandomMaker random(5);
    double least_excess = 1e30, most_excess = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const V normal = glm::normalize(random.point());
        const double gap = random.magnitude(0.1 * kReach, 1.5 * kReach), split = random.uniform(0.05, 0.95);
        glm::dvec3 w(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        w /= w.x + w.y + w.z;
        const double weights[] = {1.0, w.x, w.y, w.z};
        double sum = 0.0, at_aim = 0.0, moved = 0.0;
        for (int k = 0; k < 4; ++k) {
            const double sign = k == 0 ? 1.0 : -1.0, share = k == 0 ? split : 1 - split;
            const Share made{sign * normal, gap, 1 / share, weights[k] * kStiffness, kReach, V(0), 0.4, 1e-3};
            V d = random.point(gap);
            const double along = glm::dot(made.towards, d);  // within its half of the gap
            if (along > 0.9 * share * gap) d -= (along - 0.9 * share * gap) * made.towards;
            const V inwards = glm::dot(made.towards, d) * made.towards;  // friction apart
            sum += cpu::contact_share_energy(made, inwards);
            at_aim += cpu::contact_share_energy(made, V(0));
            moved += weights[k] * glm::dot(made.towards, d);
        }
        EXPECT_NEAR(at_aim, cpu::contact_energy(gap, kReach, kStiffness), 1e-9);
        const double excess = sum - cpu::contact_energy(gap - moved, kReach, kStiffness);
        least_excess = std::min(least_excess, excess);
        most_excess = std::max(most_excess, excess);
    }
    EXPECT_GT(least_excess, -1e-9);
    EXPECT_GT(most_excess, 1e-3);  // the bound is not trivial
}

}  // namespace
}  // namespace gelatin
