#include <gtest/gtest.h>

#include "cpu/implicit/contact_row.h"

namespace gelatin {
namespace {

constexpr double kReach = 0.02, kStiffness = 500.0;

cpu::ContactRow<double> row_with(double gap) {
    cpu::ContactRow<double> row;
    row.normal = {0.0, 1.0, 0.0};
    row.gap = gap;
    row.reach = kReach;
    row.stiffness = kStiffness;
    return row;
}

double energy(double gap) {
    return row_with(gap).energy({});
}

double force(double gap) {
    return row_with(gap).force_of(gap);
}

// Also where it is linear.
TEST(ContactLaw, ForceAndSlopeAreThoseOfTheEnergy) {
    for (double gap = 1e-4; gap < 1.5 * kReach; gap *= 1.07) {
        const double h = 1e-6 * gap;
        const auto slope = [&](const auto& of) { return (of(gap + h) - of(gap - h)) / (2 * h); };
        EXPECT_NEAR(force(gap), -slope(energy), 1e-6 * (force(gap) + 1e-6));
        const double hessian = row_with(gap).slope_of(gap);
        EXPECT_NEAR(hessian, -slope(force), 1e-5 * (hessian + 1e-3));
    }
}

TEST(ContactLaw, IsContinuousAndEndsAtTheReach) {
    for (const double gap : {cpu::ContactRow<double>::kLeastGap * kReach, 0.5 * kReach, kReach}) {
        const double below = gap * (1 - 1e-12), above = gap * (1 + 1e-12);
        EXPECT_NEAR(energy(below), energy(above), 1e-9);
        EXPECT_NEAR(force(below), force(above), 1e-9);
    }
    EXPECT_EQ(energy(kReach), 0.0);
    EXPECT_EQ(force(1.1 * kReach), 0.0);
    EXPECT_GT(force(0.11 * kReach), 2.2 * kStiffness * kReach) << "a barrier";
}

}  // namespace
}  // namespace gelatin
